#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <optional>
#include <sstream>
#include <string>

#include "tools/doctor/checks.hpp"

namespace azimuth {
namespace {

constexpr std::uint32_t kLcmGroup = (239U << 24U) | (255U << 16U) | (76U << 8U) | 67U;
constexpr unsigned kRouteUp = 1;  // RTF_UP
constexpr std::int64_t kInterfaceMulticast = 0x1000;
constexpr std::int64_t kGoodBuffer_bytes = 2 * 1024 * 1024;
constexpr const char* kRouteToLoopback = "sudo ip link set lo multicast on\nsudo ip route add 239.255.76.67/32 dev lo";

struct Route {
  std::string interface;
  std::uint32_t mask = 0;
};

/// Converts an address of /proc/net/route, which prints the network byte order as a host integer.
std::uint32_t address(std::uint32_t printed) {
  return std::endian::native == std::endian::little ? __builtin_bswap32(printed) : printed;
}

/// The route that the kernel takes to the multicast group: the matching one with the longest mask.
std::optional<Route> route_to_group(const std::string& table) {
  std::optional<Route> best;
  std::istringstream lines(table);
  std::string line;
  std::getline(lines, line);  // skips the header
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string interface;
    std::uint32_t destination = 0, gateway = 0, flags = 0, mask = 0;
    int references = 0, uses = 0, metric = 0;
    fields >> interface >> std::hex >> destination >> gateway >> flags >> std::dec >> references >> uses >> metric >>
        std::hex >> mask;
    const bool matches = fields && (flags & kRouteUp) != 0 && (kLcmGroup & address(mask)) == address(destination);
    if (matches && (!best || address(mask) > best->mask)) best = Route{interface, address(mask)};
  }
  return best;
}

}  // namespace

Finding check_multicast_route(const Machine& machine) {
  const auto table = file_content(machine.at("/proc/net/route"));
  if (!table) return {"route", Verdict::unknown, "/proc/net/route cannot be read", ""};
  const std::optional<Route> route = route_to_group(*table);
  if (!route)
    return {"route", Verdict::error, "no route to LCM's group 239.255.76.67: nothing can be sent or received",
            kRouteToLoopback};
  if (route->interface == "lo") return {"route", Verdict::ok, "LCM's group 239.255.76.67 goes through lo", ""};
  return {"route", Verdict::warning,
          fmt::format("LCM's group 239.255.76.67 goes through {0}: messages stop when {0} goes down. If no other "
                      "machine is to receive them:",
                      route->interface),
          kRouteToLoopback};
}

Finding check_loopback_multicast(const Machine& machine) {
  const auto flags = number_in(machine.at("/sys/class/net/lo/flags"), 16);
  if (!flags) return {"loopback", Verdict::unknown, "/sys/class/net/lo/flags cannot be read", ""};
  if ((*flags & kInterfaceUp) == 0) return {"loopback", Verdict::error, "lo is down", "sudo ip link set lo up"};
  if ((*flags & kInterfaceMulticast) != 0) return {"loopback", Verdict::ok, "lo carries multicast", ""};
  const auto table = file_content(machine.at("/proc/net/route"));
  const std::optional<Route> route = table ? route_to_group(*table) : std::nullopt;
  if (route && route->interface != "lo")
    return {"loopback", Verdict::ok, "lo carries no multicast, and LCM does not need it to", ""};
  return {"loopback", Verdict::error, "lo carries no multicast: programs on this machine do not hear each other",
          "sudo ip link set lo multicast on"};
}

Finding check_receive_buffer(const Machine& machine, const std::string& key) {
  const auto bytes = number_in(machine.at("/proc/sys/net/core/" + key));
  if (!bytes) return {"buffers", Verdict::unknown, "net.core." + key + " cannot be read", ""};
  const std::string found = fmt::format("net.core.{} is {} kB", key, *bytes / 1024);
  if (*bytes >= kGoodBuffer_bytes) return {"buffers", Verdict::ok, found, ""};
  return {"buffers", Verdict::warning, found + ": a receiver that pauses loses messages (2048 kB are good)",
          fmt::format("echo net.core.{0}={1} | sudo tee /etc/sysctl.d/60-lcm-{0}.conf\nsudo sysctl -w net.core.{0}={1}",
                      key, kGoodBuffer_bytes)};
}

}  // namespace azimuth
