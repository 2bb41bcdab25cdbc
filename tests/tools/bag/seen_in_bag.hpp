#pragma once
// What reading a recording tells, written down.

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

/// By visit_bag or visit_mcap.
template <class Visit>
SeenInBag seen_in(const std::string& file, const Visit& visit) {
  SeenInBag seen;
  BagVisitor visitor;
  visitor.connection = [&](const BagConnection& each) { seen.connections.push_back(each); };
  visitor.message = [&](std::uint32_t id, Stamp recorded, Bytes bytes) {
    seen.messages.push_back(std::to_string(id) + '@' + std::to_string(to_us(recorded)) + ' ' +
                            std::string(as_text(bytes)));
  };
  seen.damage = visit(std::as_bytes(std::span(file.data(), file.size())), visitor);
  return seen;
}

}  // namespace azimuth::test
