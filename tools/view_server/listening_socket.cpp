#include "tools/view_server/listening_socket.hpp"

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <netinet/in.h>
#include <optional>
#include <sys/socket.h>

namespace azimuth {
namespace {

constexpr int kBacklog = 128;

struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = 0;
};

std::optional<SocketAddress> socket_address(const std::string& address, std::uint16_t port) {
  SocketAddress made;
  auto& v4 = reinterpret_cast<sockaddr_in&>(made.storage);
  auto& v6 = reinterpret_cast<sockaddr_in6&>(made.storage);
  if (::inet_pton(AF_INET, address.c_str(), &v4.sin_addr) == 1) {
    v4.sin_family = AF_INET;
    v4.sin_port = htons(port);
    made.size = sizeof v4;
  } else if (::inet_pton(AF_INET6, address.c_str(), &v6.sin6_addr) == 1) {
    v6.sin6_family = AF_INET6;
    v6.sin6_port = htons(port);
    made.size = sizeof v6;
  } else {
    return std::nullopt;
  }
  return made;
}

std::string cause(int error, const std::string& address, std::uint16_t port) {
  const std::string where = fmt::format("{}, port {}", address, port);
  switch (error) {
    case EADDRINUSE:
      return where + ": somebody else listens there already, perhaps another azimuth view; --port 0 takes a free one";
    case EADDRNOTAVAIL:
      return where + ": this machine has no such address; `ip address` lists those it has";
    case EACCES:
      return where + ": ports below 1024 are for root alone";
    default:
      return where + ": cannot be listened on: " + std::strerror(error);
  }
}

}  // namespace

tl::expected<UniqueFd, std::string> listening_socket(const std::string& address, std::uint16_t port) {
  const std::optional<SocketAddress> where = socket_address(address, port);
  if (!where) return tl::unexpected(address + ": must be an address in numbers, such as 192.168.1.7 or ::1");
  UniqueFd socket(::socket(where->storage.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const int on = 1;
  if (socket) ::setsockopt(socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (!socket || ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&where->storage), where->size) != 0 ||
      ::listen(socket.get(), kBacklog) != 0)
    return tl::unexpected(cause(errno, address, port));
  return socket;
}

std::uint16_t port_of(const UniqueFd& socket) {
  SocketAddress bound;
  bound.size = sizeof bound.storage;
  if (::getsockname(socket.get(), reinterpret_cast<sockaddr*>(&bound.storage), &bound.size) != 0) return 0;
  return ntohs(bound.storage.ss_family == AF_INET ? reinterpret_cast<const sockaddr_in&>(bound.storage).sin_port
                                                  : reinterpret_cast<const sockaddr_in6&>(bound.storage).sin6_port);
}

bool is_address(const std::string& address) { return socket_address(address, 0).has_value(); }

bool is_loopback(const std::string& address) {
  const std::optional<SocketAddress> where = socket_address(address, 0);
  if (!where) return false;
  if (where->storage.ss_family == AF_INET)
    return (ntohl(reinterpret_cast<const sockaddr_in&>(where->storage).sin_addr.s_addr) >> 24U) == IN_LOOPBACKNET;
  return IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6&>(where->storage).sin6_addr);
}

}  // namespace azimuth
