#pragma once
// Collects everything that a reader of recordings passes to its visitor.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/bag/bag_records.hpp"

namespace azimuth::test {

struct SeenInBag {
  std::vector<std::string> messages;  ///< "connection@recorded_us bytes"
  std::vector<BagConnection> connections;
  BagDamage damage;
};

/// Collects what `visit(visitor)` passes to the visitor.
template <class Visit>
SeenInBag seen_by(const Visit& visit) {
  SeenInBag seen;
  BagVisitor visitor;
  visitor.connection = [&](const BagConnection& each) { seen.connections.push_back(each); };
  visitor.message = [&](std::uint32_t id, Stamp recorded, Bytes bytes) {
    seen.messages.push_back(std::to_string(id) + '@' + std::to_string(to_us(recorded)) + ' ' +
                            std::string(as_text(bytes)));
  };
  seen.damage = visit(visitor);
  return seen;
}

/// Collects the content of `file`; `visit` is visit_bag or visit_mcap.
template <class Visit>
SeenInBag seen_in(const std::string& file, const Visit& visit) {
  return seen_by(
      [&](const BagVisitor& visitor) { return visit(std::as_bytes(std::span(file.data(), file.size())), visitor); });
}

}  // namespace azimuth::test
