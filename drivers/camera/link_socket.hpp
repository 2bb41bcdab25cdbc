#pragma once
// Packets over a unix socket, with at most one descriptor beside them. Internal to drivers/camera.
// Nothing here blocks or raises a signal; errors are errno values.

#include <cstddef>
#include <filesystem>
#include <span>
#include <sys/types.h>

#include "base/bytes.hpp"
#include "base/unique_fd.hpp"

namespace azimuth::camera_link {

/// A socket bound to `path` that listens, for its user and the group of its folder. A socket file that nobody listens
/// at any more is replaced; 0 in `error` on success, EADDRINUSE when somebody does.
UniqueFd listen_at(const std::filesystem::path& path, int& error);

/// A connected socket, or nothing and why.
UniqueFd connect_to(const std::filesystem::path& path, int& error);

/// Whether who connected to a socket of listen_at() may: this user, root, and the members of the socket's group.
bool is_trusted_client(int socket, const std::filesystem::path& path);

/// Whether who listens at `path`, to which `socket` is connected, may be whom it names: this user or root, and anybody
/// where not everybody could have put the socket. Else `uid` is whose it is.
bool is_trusted_server(int socket, const std::filesystem::path& path, uid_t& uid);

/// 0 when the packet is on its way (`descriptor` with it unless negative), else errno; EAGAIN: the receiver is slow.
int send_packet(int socket, Bytes packet, int descriptor = -1);

struct Packet {
  enum class Outcome { packet, nothing_yet, end };
  Outcome outcome = Outcome::end;
  std::size_t bytes = 0;
  bool whole = false;   ///< false: it was longer than the room, or carried more descriptors than one
  UniqueFd descriptor;  ///< that came along
  int error = 0;        ///< of the end; 0: the other side closed
};
Packet receive_packet(int socket, std::span<std::byte> room);

}  // namespace azimuth::camera_link
