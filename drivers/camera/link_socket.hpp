#pragma once
// Packets over a Unix socket, each with at most one descriptor. Internal to drivers/camera. Nothing blocks or raises a
// signal; errors are errno values.

#include <cstddef>
#include <filesystem>
#include <span>
#include <sys/types.h>

#include "base/bytes.hpp"
#include "base/unique_fd.hpp"

namespace azimuth::camera_link {

/// Makes a listening socket at `path`, for its user and the group of its folder. Replaces a socket file on which no
/// process listens any more. `error` is 0 on success, and EADDRINUSE when another process listens.
UniqueFd listen_at(const std::filesystem::path& path, int& error);

/// A connected socket; empty on failure, with the cause in `error`.
UniqueFd connect_to(const std::filesystem::path& path, int& error);

/// True: the client connected to a socket of listen_at() is allowed: this user, root, or a member of the socket's
/// group.
bool is_trusted_client(int socket, const std::filesystem::path& path);

/// True: the server at `path`, to which `socket` is connected, can be trusted. It runs as this user or root, or not
/// everybody could have created the socket. On false, `uid` is the server's user.
bool is_trusted_server(int socket, const std::filesystem::path& path, uid_t& uid);

/// 0: the packet was sent (with `descriptor` unless that is negative). Otherwise errno; EAGAIN: the receiver is slow.
int send_packet(int socket, Bytes packet, int descriptor = -1);

struct Packet {
  enum class Outcome { packet, nothing_yet, end };
  Outcome outcome = Outcome::end;
  std::size_t bytes = 0;
  bool whole = false;   ///< false: the packet exceeded the buffer, or carried more than one descriptor
  UniqueFd descriptor;  ///< the descriptor received with the packet
  int error = 0;        ///< cause of the end; 0: the other side closed
};
Packet receive_packet(int socket, std::span<std::byte> room);

}  // namespace azimuth::camera_link
