// Any bytes as a ROS 2 bag in SQLite. Reading must end, messages must not have more bytes than the file, and a
// repetition must give the same result.

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include "tools/bag/bag_records.hpp"

namespace azimuth {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

struct Seen {
  std::uint64_t messages = 0, bytes = 0, sum = 0;
  friend bool operator==(const Seen&, const Seen&) = default;
};

Seen visit(const std::filesystem::path& file) {
  Seen seen;
  BagVisitor visitor;
  visitor.connection = [](const BagConnection&) {};
  visitor.message = [&](std::uint32_t, Stamp, Bytes message) {
    ++seen.messages;
    seen.bytes += message.size();
    for (const std::byte byte : message) seen.sum += std::to_integer<std::uint64_t>(byte);
  };
  visit_database(file, visitor);
  return seen;
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("azimuth-fuzz-" + std::to_string(::getpid()) + ".db3");
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  const azimuth::Seen seen = azimuth::visit(file);
  azimuth::require(seen == azimuth::visit(file));
  azimuth::require(seen.bytes <= size + 4096);
  std::filesystem::remove(file);
  return 0;
}
