#include "drivers/lcm/lcm_address.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <netinet/in.h>
#include <sys/socket.h>

#include "base/unique_fd.hpp"

namespace azimuth {
namespace {

constexpr std::string_view kProvider = "udpm://", kDefault = "239.255.76.67:7667";

std::optional<std::uint16_t> parse_port(std::string_view text) {
  std::uint16_t port = 0;
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (wrong != std::errc{} || end != text.data() + text.size() || port == 0) return std::nullopt;
  return port;
}

}  // namespace

std::optional<LcmAddress> parse_lcm_url(std::string_view url) {
  if (!url.starts_with(kProvider)) return std::nullopt;
  std::string_view place = url.substr(kProvider.size());
  place = place.substr(0, place.find('?'));
  if (place.empty()) place = kDefault;
  const std::size_t colon = place.find(':');
  LcmAddress address{.group = {}, .port = 7667};
  if (colon != std::string_view::npos) {
    const std::optional<std::uint16_t> port = parse_port(place.substr(colon + 1));
    if (!port) return std::nullopt;
    address.port = *port;
  }
  in_addr group{};
  if (::inet_pton(AF_INET, std::string(place.substr(0, colon)).c_str(), &group) != 1) return std::nullopt;
  std::memcpy(address.group.data(), &group, sizeof group);
  const bool is_multicast = (address.group[0] & 0xF0U) == 0xE0U;
  return is_multicast ? std::optional(address) : std::nullopt;
}

std::string text(const LcmAddress& address) {
  std::string text = "udpm://";
  for (const std::uint8_t byte : address.group) text += std::to_string(byte) + '.';
  text.back() = ':';
  return text + std::to_string(address.port);
}

int route_error(const LcmAddress& address) {
  const UniqueFd socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket) return errno;
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(address.port);
  std::memcpy(&to.sin_addr, address.group.data(), sizeof to.sin_addr);
  return ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0 ? 0 : errno;
}

}  // namespace azimuth
