#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace azimuth {

/// The destination of messages: a multicast group.
struct LcmAddress {
  std::array<std::uint8_t, 4> group{};
  std::uint16_t port = 0;
  friend bool operator==(const LcmAddress&, const LcmAddress&) = default;
};

/// Parses "udpm://239.255.76.67:7667?ttl=0". The part after the question mark concerns only the sender and is ignored.
/// Group and port may be omitted. None for another provider, or for an address that is not a multicast group.
std::optional<LcmAddress> parse_lcm_url(std::string_view url);

std::string text(const LcmAddress& address);

/// The errno of the kernel's route to a group: 0 when there is a route, ENETUNREACH without a network for it. Sends
/// nothing.
int route_error(const LcmAddress& address);

}  // namespace azimuth
