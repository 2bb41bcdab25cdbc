#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <sys/types.h>
#include <vector>

#include "base/file_result.hpp"
#include "base/unique_fd.hpp"
#include "drivers/camera/frame.hpp"
#include "drivers/camera/link_messages.hpp"
#include "drivers/camera/shared_frames.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The counters of a camera server.
struct CameraServerCounts {
  std::uint64_t clients = 0;         ///< clients that were greeted
  std::uint64_t strangers = 0;       ///< clients of untrusted users, disconnected
  std::uint64_t frames = 0;          ///< frames sent
  std::uint64_t frames_skipped = 0;  ///< frames skipped: no client, no free slot, or the client's inbox was full
  std::uint64_t sets = 0;
  std::uint64_t sets_skipped = 0;
  std::uint64_t malformed = 0;  ///< invalid messages from clients; each ends its connection
};

/// The sending end of the camera link. It hands images or bearings to one process of this machine at a time (see
/// SharedCamera). The client's user must be the server's user, root, or a member of the socket's group. Further clients
/// wait until the current one has gone. A slow or dead client loses samples, and disturbs nobody else.
///
/// Thread contract: thread-bound. Nothing blocks, and nothing allocates after the first samples.
class CameraServer {
 public:
  /// Creates a socket at `path`, and replaces a stale one. Frames have `format`; `max_jpeg_bytes` limits their size for
  /// mjpeg. Without slots the server sends only bearings and does not use `format`.
  struct Offer {
    FrameFormat format{};
    unsigned slots = 4;  ///< at most FramePool::kMaxSlots; each holds a whole frame
    std::size_t max_jpeg_bytes = 0;
  };
  static FileResult<CameraServer> listen(const std::filesystem::path& path, const Offer& offer);
  static FileResult<CameraServer> listen_for_bearings(const std::filesystem::path& path);

  CameraServer(CameraServer&&) noexcept;
  CameraServer(const CameraServer&) = delete;
  CameraServer& operator=(CameraServer&&) = delete;
  CameraServer& operator=(const CameraServer&) = delete;
  /// Removes the socket from the file system.
  ~CameraServer();

  /// For an event loop: readable when turn() has something to do. The descriptor never changes.
  int descriptor() const { return events_.get(); }
  /// Greets a client and takes slots back. To be called before each sending as well.
  void turn();
  bool has_client() const { return static_cast<bool>(client_); }

  /// A free slot for the next frame. Empty: there is no client or no free slot, and the frame is skipped. A skipped
  /// frame consumes a sequence number too. A slot that was not sent is returned again by the next call.
  std::span<std::byte> next_frame();
  /// Consumes a sequence number for a frame that is not made. The slot from the last next_frame() stays valid.
  void skip_frame();
  /// Sends the slot from next_frame(); for mjpeg only its first `bytes` bytes. `stamp` is on CLOCK_MONOTONIC. False:
  /// not sent, because next_frame() returned no slot, `bytes` is zero or too large, or there is no client.
  bool send_frame(Stamp stamp);
  bool send_jpeg(Stamp stamp, std::size_t bytes);

  /// Sends a bearing set with its stamp (on CLOCK_MONOTONIC) and sequence number. False: skipped.
  bool send(const BearingSet& set);

  const CameraServerCounts& counts() const { return counts_; }

 private:
  CameraServer(std::filesystem::path path, const camera_link::Hello& hello, camera_link::FrameMemory memory);
  static FileResult<CameraServer> start(const std::filesystem::path& path, const camera_link::Hello& hello);

  int open();
  void accept_client();
  void read_client();
  void drop_client();
  void take_back(std::span<const std::byte> message);
  bool watch(int fd) const;
  bool transmit();

  static constexpr unsigned kNoSlot = FramePool::kMaxSlots;
  struct Slot {
    bool leased = false;
    std::uint64_t sequence = 0;
  };

  std::filesystem::path path_;
  camera_link::Hello hello_;
  camera_link::FrameMemory memory_;
  UniqueFd events_, listener_, client_;
  ino_t socket_file_ = 0;
  std::array<Slot, FramePool::kMaxSlots> slots_{};
  unsigned next_slot_ = kNoSlot;
  std::uint64_t next_sequence_ = 0;  // sequence number of the frame in next_slot_
  std::uint64_t sequence_ = 0;
  std::vector<std::byte> message_;
  CameraServerCounts counts_;
};

}  // namespace azimuth
