// Any text as a DBC file. It must be refused with existing line numbers, or every signal without a stated problem must
// be readable from a frame of its size.

#include <algorithm>
#include <cstdlib>

#include "drivers/can/dbc.hpp"

namespace azimuth {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

void check(const DbcMessage& message, const DbcSignal& signal) {
  if (signal.problem) return;
  require(!problem_of(signal.signal));
  require(signal.signal.frame == message.id);
  CanFrame frame;
  frame.id = message.id;
  frame.size = static_cast<std::uint8_t>(message.size);
  require(decode(signal.signal, frame).found != CanFound::too_short);
}

void check(std::string_view text) {
  const auto lines = 1 + std::ranges::count(text, '\n');
  const FileResult<Dbc> dbc = read_dbc(text, "file");
  if (!dbc) {
    for (const FileError& error : dbc.error()) require(error.line >= 1 && error.line <= lines);
    return;
  }
  for (const DbcMessage& message : dbc->messages) {
    require(message.size >= 0 && message.size <= 64);
    for (const DbcSignal& signal : message.signals) {
      require(dbc->find(message.name + '.' + signal.name) != nullptr);
      check(message, signal);
    }
  }
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  azimuth::check({reinterpret_cast<const char*>(data), size});
  return 0;
}
