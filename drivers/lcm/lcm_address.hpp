#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace azimuth {

/// Where messages are sent to: a multicast group.
struct LcmAddress {
  std::array<std::uint8_t, 4> group{};
  std::uint16_t port = 0;
  friend bool operator==(const LcmAddress&, const LcmAddress&) = default;
};

/// "udpm://239.255.76.67:7667?ttl=0"; what follows the question mark is the sender's business. Group and port may be
/// left out. Nothing for another provider, or for an address that is no multicast group.
std::optional<LcmAddress> parse_lcm_url(std::string_view url);

std::string text(const LcmAddress& address);

}  // namespace azimuth
