// Any datagrams from any senders. The viewer's output must stay bounded and must be a stream of valid events.
//
// Input: datagrams, each after one byte (two bits of sender, six of time) and two of length.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "tools/view/lcm_intake.hpp"
#include "tools/view/looker.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kLongestEvent = 4'000'000;

void require(bool condition) {
  if (!condition) std::abort();
}

/// Each event must have its three lines, and its data must be JSON.
void check_stream(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find("\n\n");
    require(end != std::string_view::npos && end < kLongestEvent);
    const std::string_view event = text.substr(0, end);
    text.remove_prefix(end + 2);
    const std::size_t data = event.find("\ndata: ");
    require(event.starts_with("event: ") && data != std::string_view::npos);
    require(event.find('\n', data + 1) == std::string_view::npos);
    require(nlohmann::json::accept(event.substr(data + 7)));
  }
}

std::string read_all(Looker& looker) {
  std::string text;
  std::array<char, 4096> room{};
  while (const std::size_t count = looker.read(room)) text.append(room.data(), count);
  return text;
}

void feed(Bytes input) {
  const auto take = [&input](std::size_t size) {
    const Bytes taken = input.first(std::min(size, input.size()));
    input = input.subspan(taken.size());
    return taken;
  };
  const std::chrono::steady_clock::time_point start{std::chrono::hours(1)};
  Lookers lookers;
  LiveView view("fuzzed", "nowhere", lookers, start,
                {.trail_points = 50,
                 .trail_piece = 20,
                 .landmarks = 20,
                 .path_points = 20,
                 .bearings = 20,
                 .pieces = 4,
                 .picture_bytes = 5000,
                 .text_bytes = 50,
                 .journal_lines = 5});
  LcmIntake intake(view, "");
  Looker early(view, lookers);
  LcmReceipt receipt{stamp_from_us(1'700'000'000'000'000), Duration{}};
  while (input.size() > 3) {
    const Bytes head = take(3);
    const auto choices = std::to_integer<unsigned>(head[0]);
    receipt.stamp += Duration{1 + 20'000 * (choices >> 2U)};
    const std::size_t size = 256U * std::to_integer<std::size_t>(head[1]) + std::to_integer<std::size_t>(head[2]);
    if (const auto packet = decode_lcm_packet(take(size))) intake.accept(*packet, choices & 3U, receipt);
    if (choices % 5 == 0) check_stream(read_all(early));
  }
  check_stream(read_all(early));
  Looker late(view, lookers);
  check_stream(read_all(late));
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  azimuth::feed({reinterpret_cast<const std::byte*>(data), size});
  return 0;
}
