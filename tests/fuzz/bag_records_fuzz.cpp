// Any bytes as a ROS 1 bag and as MCAP. Reading must reach the end, messages must lie within the given or unpacked
// bytes, and a repetition must give the same result.

#include <cstdint>
#include <cstdlib>
#include <span>

#include "tools/bag/bag_records.hpp"

namespace azimuth {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

struct Seen {
  std::uint64_t messages = 0, bytes = 0, connections = 0;
};

Seen visit(BagDamage (*format)(Bytes, const BagVisitor&), Bytes bag) {
  Seen seen;
  BagVisitor visitor;
  visitor.connection = [&](const BagConnection& connection) {
    ++seen.connections;
    require(connection.topic.size() <= kMaxChunkBytes);
  };
  visitor.message = [&](std::uint32_t, Stamp, Bytes message) {
    ++seen.messages;
    for (const std::byte byte : message) seen.bytes += std::to_integer<std::uint64_t>(byte);
  };
  const BagDamage damage = format(bag, visitor);
  require(damage.bytes <= bag.size());
  return seen;
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const azimuth::Bytes bag = std::as_bytes(std::span(data, size));
  for (const auto format : {azimuth::visit_bag, azimuth::visit_mcap}) {
    const azimuth::Seen whole = azimuth::visit(format, bag);
    const azimuth::Seen again = azimuth::visit(format, bag);
    azimuth::require(whole.messages == again.messages && whole.bytes == again.bytes);
  }
  return 0;
}
