#include "drivers/camera/link_socket.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

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

/// Removes the socket of a server that was killed, but no other files and no socket in use.
void remove_stale(const std::filesystem::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISSOCK(status.st_mode)) return;
  int error = 0;
  if (!connect_to(path, error) && error == ECONNREFUSED) ::unlink(path.c_str());
}

constexpr mode_t kUserAndGroup = 0660;

std::optional<ucred> peer_of(int socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return std::nullopt;
  return peer;
}

bool is_member(int socket, const ucred& peer, gid_t group) {
  if (peer.gid == group) return true;
  std::array<gid_t, 256> groups{};
  socklen_t size = sizeof groups;
  if (::getsockopt(socket, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &size) != 0) return false;
  const auto end = groups.begin() + static_cast<std::ptrdiff_t>(size / sizeof(gid_t));
  return std::find(groups.begin(), end, group) != end;
}

bool is_own_or_root(const ucred& peer) { return peer.uid == ::geteuid() || peer.uid == 0; }

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// Gives the socket to the group of its folder if this process is a member of it, so that a camera of another user can
/// serve the daemon that owns the folder. Restores the permissions that the umask removed.
bool give_to_group(const std::filesystem::path& path) {
  struct stat folder {};
  if (::stat(folder_of(path).c_str(), &folder) == 0) {
    const int refused = ::lchown(path.c_str(), static_cast<uid_t>(-1), folder.st_gid);
    static_cast<void>(refused);  // on failure the socket is only for this process's own group
  }
  return ::chmod(path.c_str(), kUserAndGroup) == 0;
}

/// Room for the control messages of two descriptors, so that a second one is noticed and closed.
union Control {
  cmsghdr alignment;
  char bytes[CMSG_SPACE(2 * sizeof(int))];
};

/// Takes all received descriptors. False: there was more than one, or the control data were truncated.
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
  // The permissions are set before the socket gets its name, so that no other user can connect in between.
  const bool is_bound =
      ::fchmod(fd.get(), kUserAndGroup) == 0 && ::bind(fd.get(), generic(*address), sizeof *address) == 0;
  if (is_bound && give_to_group(path) && ::listen(fd.get(), kBacklog) == 0) return fd;
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

bool is_trusted_client(int socket, const std::filesystem::path& path) {
  const std::optional<ucred> peer = peer_of(socket);
  struct stat status {};
  if (!peer) return false;
  return is_own_or_root(*peer) || (::lstat(path.c_str(), &status) == 0 && is_member(socket, *peer, status.st_gid));
}

bool is_trusted_server(int socket, const std::filesystem::path& path, uid_t& uid) {
  const std::optional<ucred> peer = peer_of(socket);
  if (!peer) return false;
  uid = peer->uid;
  struct stat status {};
  return is_own_or_root(*peer) || (::stat(folder_of(path).c_str(), &status) == 0 && (status.st_mode & S_IWOTH) == 0);
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
  // An empty packet looks like the end; a correct peer sends none.
  packet.outcome = received == 0 ? Packet::Outcome::end : Packet::Outcome::packet;
  return packet;
}

}  // namespace azimuth::camera_link
