#pragma once
// Both ends of the camera link between processes of one machine: CameraServer (camera_server.hpp) hands out,
// SharedCamera takes. Frames travel in shared memory, bearing sets as messages.

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
  bool connected = false;  ///< and greeted
  /// Connected since then, but not greeted: the server looks after one at a time. None: otherwise.
  std::optional<std::chrono::steady_clock::time_point> waiting_since;
  FrameFormat format{};               ///< of the frames to come; width 0: bearings only
  std::uint64_t connections = 0;      ///< greeted so far
  std::uint64_t frames = 0;           ///< received
  std::uint64_t frames_missing = 0;   ///< gaps in their sequence numbers
  std::uint64_t frames_replaced = 0;  ///< received but not taken in time
  std::uint64_t sets = 0;
  std::uint64_t sets_missing = 0;
  std::uint64_t sets_replaced = 0;
  std::uint64_t malformed = 0;  ///< messages that were not what they should be
  std::string error;            ///< why there is no connection; empty when there is one
};

/// A camera in another process, found at a unix socket: a simulated one, or a front end of its own. Connects by itself,
/// again and again, and survives whatever happens to, or is sent by, the other side. Unread samples are kept up to
/// kMaxSets sets and kMaxFrames frames, of which the oldest go first.
///
/// Stamps are on CLOCK_MONOTONIC. Sequence numbers start anew with each server.
///
/// Thread contract: thread-bound; frames may die elsewhere. Nothing here blocks, and while connected nothing allocates
/// once every set has seen its greatest size.
class SharedCamera {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kMaxSets = 16;
  static constexpr std::size_t kMaxFrames = 2;

  /// Throws std::system_error when the process is out of descriptors.
  explicit SharedCamera(std::filesystem::path path);
  SharedCamera(const SharedCamera&) = delete;
  SharedCamera& operator=(const SharedCamera&) = delete;

  /// For an event loop: readable when turn() has something to do. Stays the same for the life of this object.
  int descriptor() const { return events_.get(); }
  /// Connects when it is time to, returns leases, receives.
  void turn(Clock::time_point now);
  /// When turn() should be called even if nothing is readable; never, while there is a connection.
  Clock::time_point next_turn() const { return socket_ ? Clock::time_point::max() : back_off_.due(); }

  /// The oldest unread one; leaves the storage of `into` behind. False: none, `into` unchanged.
  bool take(BearingSet& into);
  /// The oldest unread one; what `into` held before is released. False: none, `into` unchanged.
  bool take(Frame& into);

  const SharedCameraState& state() const { return state_; }

 private:
  /// A short queue in fixed places.
  template <class T, std::size_t Places>
  struct Unread {
    std::array<T, Places> items{};
    std::size_t first = 0, count = 0;
    /// The place after the newest, at the cost of the oldest when all are used; then `replaced` is counted up.
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
  std::uint32_t leased_ = 0;                           // slots that are ours, one bit each
  std::uint32_t unreturned_ = 0;                       // of them, those to be given back
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
