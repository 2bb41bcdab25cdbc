#include "tests/guest/flood/random_can_frame.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace azimuth::guest {
namespace {

/// Number of data bytes for each data length code of CAN FD.
constexpr std::array<std::uint8_t, 16> kFdLengths{0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};
constexpr std::uint64_t kRemoteOneIn = 8;

bool is_spared(const CanFloodKinds& kinds, std::uint32_t number) {
  return std::ranges::find(kinds.spared, number) != kinds.spared.end();
}

std::uint32_t random_number(const CanFloodKinds& kinds, std::uint32_t last, std::mt19937_64& random) {
  std::uniform_int_distribution<std::uint32_t> any(kinds.first_id, std::min(kinds.last_id, last));
  std::uint32_t number = any(random);
  while (is_spared(kinds, number)) number = any(random);
  return number;
}

}  // namespace

bool leaves_identifiers(const CanFloodKinds& kinds) {
  if (kinds.first_id > kinds.last_id || kinds.last_id > CAN_EFF_MASK) return false;
  const auto left = [&](std::uint32_t last) {
    if (kinds.first_id > last) return true;  // the range has no identifiers of this kind
    const std::uint32_t end = std::min(kinds.last_id, last);
    for (std::uint32_t number = kinds.first_id; number <= end; ++number) {
      if (!is_spared(kinds, number)) return true;
    }
    return false;
  };
  return left(CAN_SFF_MASK) && left(CAN_EFF_MASK);
}

FloodFrame random_can_frame(const CanFloodKinds& kinds, std::mt19937_64& random) {
  assert(leaves_identifiers(kinds));
  FloodFrame made;
  canfd_frame& frame = made.frame;
  const bool extended = kinds.first_id > CAN_SFF_MASK || random() % 2 == 0;
  frame.can_id = random_number(kinds, extended ? CAN_EFF_MASK : CAN_SFF_MASK, random) | (extended ? CAN_EFF_FLAG : 0);
  if (kinds.fd && random() % 2 == 0) {
    made.bytes = CANFD_MTU;
    frame.len = kFdLengths.at(random() % kFdLengths.size());
    frame.flags = random() % 2 == 0 ? CANFD_BRS : 0;
  } else {
    frame.len = static_cast<std::uint8_t>(random() % (CAN_MAX_DLEN + 1));
    if (random() % kRemoteOneIn == 0) frame.can_id |= CAN_RTR_FLAG;
  }
  const bool carries_data = (frame.can_id & CAN_RTR_FLAG) == 0;
  for (std::size_t i = 0; carries_data && i < frame.len; ++i) frame.data[i] = static_cast<std::uint8_t>(random());
  return made;
}

}  // namespace azimuth::guest
