#include "sim/pioneer/tcp_carrier.hpp"

#include <array>
#include <cerrno>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include "base/file_result.hpp"

namespace azimuth::sim {
namespace {

/// Connections that are queued while this program is stopped, as by other servers.
constexpr int kWaiting = 16;

void switch_on(int fd, int level, int option) {
  const int on = 1;
  ::setsockopt(fd, level, option, &on, sizeof on);
}

}  // namespace

FileResult<void> TcpCarrier::plug_in() {
  if (listener_) return {};
  UniqueFd listener(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!listener) return failure(system_error(address(), "no socket", errno));
  switch_on(listener.get(), SOL_SOCKET, SO_REUSEADDR);
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  where.sin_port = htons(port_);
  auto* const generic = reinterpret_cast<sockaddr*>(&where);
  socklen_t size = sizeof where;
  if (::bind(listener.get(), generic, size) != 0 || ::listen(listener.get(), kWaiting) != 0 ||
      ::getsockname(listener.get(), generic, &size) != 0) {
    return failure(system_error(address(), "cannot be listened on", errno));
  }
  port_ = ntohs(where.sin_port);
  listener_ = std::move(listener);
  return {};
}

void TcpCarrier::unplug() {
  forgotten_.clear();
  client_ = UniqueFd();
  listener_ = UniqueFd();
}

void TcpCarrier::watch(std::vector<pollfd>& watched) const {
  if (listener_) watched.push_back({listener_.get(), POLLIN, 0});
  if (client_) watched.push_back({client_.get(), POLLIN, 0});
}

void TcpCarrier::turn(Bytes& from_client) {
  if (client_) hear_client(from_client);
  if (listener_) accept_client();
}

void TcpCarrier::accept_client() {
  UniqueFd client(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!client || client_) return;  // A second client is rejected
  switch_on(client.get(), IPPROTO_TCP, TCP_NODELAY);
  client_ = std::move(client);
}

void TcpCarrier::hear_client(Bytes& from_client) {
  std::array<std::uint8_t, 512> buffer{};
  ssize_t count = 0;
  while ((count = ::recv(client_.get(), buffer.data(), buffer.size(), 0)) > 0) {
    from_client.insert(from_client.end(), buffer.begin(), buffer.begin() + count);
  }
  const bool gone = count == 0 || (errno != EAGAIN && errno != EINTR);
  if (gone) client_ = UniqueFd();
}

void TcpCarrier::send(pioneer::ByteView bytes) {
  if (!client_) return;
  const ssize_t sent = ::send(client_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  const bool gone = sent < 0 && errno != EAGAIN && errno != EINTR;
  if (gone) client_ = UniqueFd();
}

std::string TcpCarrier::address() const { return fmt::format("tcp:127.0.0.1:{}", port_); }

}  // namespace azimuth::sim
