#pragma once
#include <cstddef>
#include <cstdint>
#include <linux/can.h>
#include <random>
#include <vector>

namespace azimuth::guest {

/// Which frames a flood may be made of. `first_id` to `last_id` bounds standard and extended identifiers alike; no
/// identifier of 11 bits exceeds 0x7ff.
struct CanFloodKinds {
  std::uint32_t first_id = 0, last_id = CAN_EFF_MASK;
  std::vector<std::uint32_t> spared;  ///< numbers that are never sent, as either kind
  bool fd = false;                    ///< the interface takes frames of CAN FD as well
};

/// A frame as a raw socket takes it: `bytes` of `frame`, CAN_MTU or CANFD_MTU.
struct FloodFrame {
  canfd_frame frame{};
  std::size_t bytes = CAN_MTU;
};

/// Any frame a bus can carry: standard, extended or remote, of each length, with any data; half of them of CAN FD if
/// the bus takes those. Same generator, same frame. The kinds must leave an identifier to send; when most of the range
/// is spared this takes its time.
FloodFrame random_can_frame(const CanFloodKinds& kinds, std::mt19937_64& random);

/// Whether random_can_frame() has anything to choose from.
bool leaves_identifiers(const CanFloodKinds& kinds);

}  // namespace azimuth::guest
