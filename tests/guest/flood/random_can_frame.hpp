#pragma once
#include <cstddef>
#include <cstdint>
#include <linux/can.h>
#include <random>
#include <vector>

namespace azimuth::guest {

/// The kinds of frames in a flood. The range `first_id` to `last_id` holds for standard and for extended identifiers;
/// an identifier of 11 bits is at most 0x7ff.
struct CanFloodKinds {
  std::uint32_t first_id = 0, last_id = CAN_EFF_MASK;
  std::vector<std::uint32_t> spared;  ///< Identifiers that are never sent, neither standard nor extended.
  bool fd = false;                    ///< The interface accepts CAN FD frames too.
};

/// A frame for a raw socket: `bytes` bytes of `frame`, which is CAN_MTU or CANFD_MTU.
struct FloodFrame {
  canfd_frame frame{};
  std::size_t bytes = CAN_MTU;
};

/// A random valid frame: standard, extended or remote, of any length, with any data. Half of the frames are CAN FD if
/// the bus accepts these. Equal generators give equal frames. The kinds must leave an identifier; the function is slow
/// if most of the range is spared.
FloodFrame random_can_frame(const CanFloodKinds& kinds, std::mt19937_64& random);

/// True if the kinds leave an identifier of each length that the range contains.
bool leaves_identifiers(const CanFloodKinds& kinds);

}  // namespace azimuth::guest
