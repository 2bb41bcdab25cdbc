#include "drivers/camera/link_socket.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

namespace azimuth::camera_link {

namespace {

constexpr int kBacklog = 4;

std::optional<sockaddr_un> address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& text = path.native();
  if (text.empty() || text.size() >= sizeof address.sun_path || text.find('\0') != std::string::npos)
    return std::nullopt;
  std::copy(text.begin(), text.end(), address.sun_path);
  return address;
}

UniqueFd make_socket(int& error) {
  UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  error = fd ? 0 : errno;
  return fd;
}

const sockaddr* generic(const sockaddr_un& address) { return reinterpret_cast<const sockaddr*>(&address); }

/// Removes what a server that was killed left behind, but neither other files nor a socket in use.
void remove_stale(const std::filesystem::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISSOCK(status.st_mode)) return;
  int error = 0;
  if (!connect_to(path, error) && error == ECONNREFUSED) ::unlink(path.c_str());
}

/// Room for the control messages of two descriptors, so that a second one is seen and closed.
union Control {
  cmsghdr alignment;
  char bytes[CMSG_SPACE(2 * sizeof(int))];
};

/// Takes over every descriptor that came along; false when there was more than one, or what did not fit was cut off.
bool take_descriptors(msghdr& header, UniqueFd& into) {
  bool one_at_most = (static_cast<unsigned>(header.msg_flags) & static_cast<unsigned>(MSG_CTRUNC)) == 0;
  for (cmsghdr* item = CMSG_FIRSTHDR(&header); item != nullptr; item = CMSG_NXTHDR(&header, item)) {
    if (item->cmsg_level != SOL_SOCKET || item->cmsg_type != SCM_RIGHTS) continue;
    const std::size_t count = (item->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t i = 0; i < count; ++i) {
      int fd = -1;
      std::memcpy(&fd, CMSG_DATA(item) + i * sizeof fd, sizeof fd);
      UniqueFd owned(fd);
      if (into) {
        one_at_most = false;
      } else {
        into = std::move(owned);
      }
    }
  }
  return one_at_most;
}

}  // namespace

UniqueFd listen_at(const std::filesystem::path& path, int& error) {
  const std::optional<sockaddr_un> address = address_of(path);
  error = ENAMETOOLONG;
  if (!address) return {};
  UniqueFd fd = make_socket(error);
  if (!fd) return {};
  remove_stale(path);
  if (::bind(fd.get(), generic(*address), sizeof *address) == 0 && ::listen(fd.get(), kBacklog) == 0) return fd;
  error = errno;
  return {};
}

UniqueFd connect_to(const std::filesystem::path& path, int& error) {
  const std::optional<sockaddr_un> address = address_of(path);
  error = ENAMETOOLONG;
  if (!address) return {};
  UniqueFd fd = make_socket(error);
  if (!fd || ::connect(fd.get(), generic(*address), sizeof *address) == 0) return fd;
  error = errno;
  return {};
}

int send_packet(int socket, Bytes packet, int descriptor) {
  iovec part{const_cast<std::byte*>(packet.data()), packet.size()};
  Control control{};
  msghdr header{};
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  if (descriptor >= 0) {
    header.msg_control = control.bytes;
    header.msg_controllen = CMSG_SPACE(sizeof(int));
    cmsghdr* const item = CMSG_FIRSTHDR(&header);
    item->cmsg_level = SOL_SOCKET;
    item->cmsg_type = SCM_RIGHTS;
    item->cmsg_len = CMSG_LEN(sizeof(int));
    std::memcpy(CMSG_DATA(item), &descriptor, sizeof descriptor);
  }
  while (::sendmsg(socket, &header, MSG_NOSIGNAL | MSG_DONTWAIT) < 0) {
    if (errno != EINTR) return errno;
  }
  return 0;
}

Packet receive_packet(int socket, std::span<std::byte> room) {
  iovec part{room.data(), room.size()};
  Control control{};
  msghdr header{};
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  header.msg_control = control.bytes;
  header.msg_controllen = sizeof control.bytes;
  ssize_t received = -1;
  do {
    received = ::recvmsg(socket, &header, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
  } while (received < 0 && errno == EINTR);

  Packet packet;
  if (received < 0) {
    const bool later = errno == EAGAIN || errno == EWOULDBLOCK;  // NOLINT(misc-redundant-expression): may differ
    packet.outcome = later ? Packet::Outcome::nothing_yet : Packet::Outcome::end;
    packet.error = later ? 0 : errno;
    return packet;
  }
  packet.whole = take_descriptors(header, packet.descriptor);
  if (static_cast<unsigned>(header.msg_flags) & static_cast<unsigned>(MSG_TRUNC)) packet.whole = false;
  packet.bytes = static_cast<std::size_t>(received);
  // An empty packet looks like the end; nobody who means well sends one.
  packet.outcome = received == 0 ? Packet::Outcome::end : Packet::Outcome::packet;
  return packet;
}

}  // namespace azimuth::camera_link
