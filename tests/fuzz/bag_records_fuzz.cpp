// Any bytes as a bag: gone through to its end, every message within what was given or unpacked, and the same each time.

#include <cstdint>
#include <cstdlib>
#include <span>

#include "tools/import/bag_records.hpp"

namespace azimuth {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

struct Seen {
  std::uint64_t messages = 0, bytes = 0, connections = 0;
};

Seen visit(Bytes bag) {
  Seen seen;
  BagVisitor visitor;
  visitor.connection = [&](const BagConnection& connection) {
    ++seen.connections;
    require(connection.topic.size() <= bag.size());
  };
  visitor.message = [&](std::uint32_t, Stamp, Bytes message) {
    ++seen.messages;
    for (const std::byte byte : message) seen.bytes += std::to_integer<std::uint64_t>(byte);
  };
  const BagDamage damage = visit_bag(bag, visitor);
  require(damage.bytes <= bag.size());
  return seen;
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const azimuth::Bytes bag = std::as_bytes(std::span(data, size));
  const azimuth::Seen whole = azimuth::visit(bag);
  const azimuth::Seen again = azimuth::visit(bag);
  azimuth::require(whole.messages == again.messages && whole.bytes == again.bytes);
  return 0;
}
