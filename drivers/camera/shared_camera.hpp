#pragma once
// The receiving end of the camera link between processes of one machine; CameraServer (camera_server.hpp) is the
// sending end. Frames travel in shared memory, bearing sets as messages.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/unique_fd.hpp"
#include "drivers/camera/camera_server.hpp"
#include "drivers/camera/frame.hpp"
#include "drivers/camera/link_messages.hpp"
#include "drivers/camera/shared_frames.hpp"
#include "drivers/device/back_off.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

struct SharedCameraState {
  bool connected = false;  ///< connected and greeted
  /// The time of a connection that has not been greeted yet, because the server serves one client at a time. None:
  /// otherwise.
  std::optional<std::chrono::steady_clock::time_point> waiting_since;
  FrameFormat format{};               ///< format of the frames; width 0: bearings only
  std::uint64_t connections = 0;      ///< connections that were greeted
  std::uint64_t frames = 0;           ///< frames received
  std::uint64_t frames_missing = 0;   ///< gaps in the frames' sequence numbers
  std::uint64_t frames_replaced = 0;  ///< frames received but not taken in time
  std::uint64_t sets = 0;
  std::uint64_t sets_missing = 0;
  std::uint64_t sets_replaced = 0;
  std::uint64_t malformed = 0;  ///< invalid messages
  std::string error;            ///< why there is no connection; empty while connected
};

/// A camera in another process, reached through a Unix socket: a simulated camera, or a separate front end. It connects
/// by itself, repeatedly, and survives any behaviour of the other side. It keeps up to kMaxSets unread sets and
/// kMaxFrames unread frames, and drops the oldest first.
///
/// Stamps are on CLOCK_MONOTONIC. Sequence numbers start again with each server.
///
/// Thread contract: thread-bound; frames may be destroyed on any thread. Nothing blocks. While connected, nothing
/// allocates once every set has reached its largest size.
class SharedCamera {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kMaxSets = 16;
  static constexpr std::size_t kMaxFrames = 2;

  /// Throws std::system_error when the process is out of descriptors.
  explicit SharedCamera(std::filesystem::path path);
  SharedCamera(const SharedCamera&) = delete;
  SharedCamera& operator=(const SharedCamera&) = delete;

  /// For an event loop: readable when turn() has something to do. The descriptor never changes.
  int descriptor() const { return events_.get(); }
  /// Connects when it is time to, returns leases, and receives messages.
  void turn(Clock::time_point now);
  /// When turn() is needed even if nothing is readable; never while connected.
  Clock::time_point next_turn() const { return socket_ ? Clock::time_point::max() : back_off_.due(); }

  /// Takes the oldest unread set, and keeps the storage of `into`. False: there is none, `into` is unchanged.
  bool take(BearingSet& into);
  /// Takes the oldest unread frame, and releases the previous contents of `into`. False: there is none, `into` is
  /// unchanged.
  bool take(Frame& into);

  const SharedCameraState& state() const { return state_; }

 private:
  /// A short queue of fixed capacity.
  template <class T, std::size_t Places>
  struct Unread {
    std::array<T, Places> items{};
    std::size_t first = 0, count = 0;
    /// The place after the newest element. When the queue is full, the oldest is dropped and `replaced` is incremented.
    T& claim(std::uint64_t& replaced);
    bool pop(T& into);
  };
  /// Finds gaps in sequence numbers.
  struct Gaps {
    std::optional<std::uint64_t> last;
    std::uint64_t missing_before(std::uint64_t sequence);
  };

  void connect(Clock::time_point now);
  void disconnect(Clock::time_point now, std::string_view why);
  void return_leases();
  void receive(Clock::time_point now);
  bool accept_hello(std::span<const std::byte> message, const UniqueFd& memory);
  void accept(std::span<const std::byte> message);
  bool accept_frame(std::span<const std::byte> message);
  bool accept_bearings(std::span<const std::byte> message);
  bool watch(int fd) const;

  std::filesystem::path path_;
  UniqueFd events_, socket_;
  camera_link::Hello hello_;
  std::shared_ptr<camera_link::MappedFrames> frames_;  // null: not greeted, or bearings only
  std::uint32_t leased_ = 0;                           // slots held by this client, one bit each
  std::uint32_t unreturned_ = 0;                       // leased slots to be given back
  std::array<std::uint64_t, FramePool::kMaxSlots> lease_sequence_{};
  Gaps frame_gaps_, set_gaps_;
  Unread<BearingSet, kMaxSets> unread_sets_;
  Unread<Frame, kMaxFrames> unread_frames_;
  BearingSet decoded_;
  std::vector<std::byte> received_, sent_;
  BackOff back_off_;
  SharedCameraState state_;
};

}  // namespace azimuth
