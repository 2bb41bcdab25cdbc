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

/// What became of everything a server had to send.
struct CameraServerCounts {
  std::uint64_t clients = 0;         ///< that were greeted
  std::uint64_t strangers = 0;       ///< of other users, hung up on
  std::uint64_t frames = 0;          ///< handed over
  std::uint64_t frames_skipped = 0;  ///< no client, no free slot, or its inbox was full
  std::uint64_t sets = 0;
  std::uint64_t sets_skipped = 0;
  std::uint64_t malformed = 0;  ///< messages of clients that mean nothing; each ends its connection
};

/// The end of the camera link that has images or bearings: hands them to one process of this machine at a time (see
/// SharedCamera), whose user is this one, root or of the socket's group. Further ones wait until it is gone. A client
/// that is slow or dead costs itself samples and nobody anything else.
///
/// Thread contract: thread-bound. Nothing here blocks, and after the first samples nothing allocates.
class CameraServer {
 public:
  /// Makes a socket at `path`; a stale one is replaced. Frames have `format`; for mjpeg, `max_jpeg_bytes` bounds them.
  /// No slots: a server of bearings only, `format` is not used.
  struct Offer {
    FrameFormat format{};
    unsigned slots = 4;  ///< at most FramePool::kMaxSlots; each is a whole frame
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

  /// For an event loop: readable when turn() has something to do. Stays the same.
  int descriptor() const { return events_.get(); }
  /// Greets a client, takes slots back. To be called before sending, too.
  void turn();
  bool has_client() const { return static_cast<bool>(client_); }

  /// A free slot for the next frame; empty when there is nobody to see it or no slot is free: that frame is skipped.
  /// Either way it has used up a sequence number. A slot not sent is simply given again.
  std::span<std::byte> next_frame();
  /// Uses up a sequence number for a frame that nobody will make; the slot last given stays valid.
  void skip_frame();
  /// Hands over the slot that next_frame() gave, the first `bytes` of it for mjpeg. `stamp` is on CLOCK_MONOTONIC.
  /// False: nobody gets it, since it gave none, or there are none or more bytes than one holds, or nobody listens.
  bool send_frame(Stamp stamp);
  bool send_jpeg(Stamp stamp, std::size_t bytes);

  /// Sends a set with the stamp (on CLOCK_MONOTONIC) and the sequence that it has. False: skipped.
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
  std::uint64_t next_sequence_ = 0;  // of the frame in that slot
  std::uint64_t sequence_ = 0;
  std::vector<std::byte> message_;
  CameraServerCounts counts_;
};

}  // namespace azimuth
