#pragma once
// Internal to drivers/camera.

#include <chrono>
#include <cstdint>
#include <optional>

#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Judges the stamps and sequence numbers of one camera's images, stream after stream, so that what is handed on
/// strictly ascends.
///
/// Thread contract: thread-bound. Nothing allocates.
class ImageOrder {
 public:
  using Clock = std::chrono::steady_clock;
  /// A clock of the kernel's may be read a little later than ours.
  static constexpr Duration kFuture{2'000};
  /// No image takes so long from its exposure to this process, unless the process itself stood still.
  static constexpr Duration kOldest{2'000'000};
  /// So many unusable stamps in a row are no accident but a device whose clock is another: from then on the time of
  /// arrival stands in for them, which is worse than a stamp but better than no image.
  static constexpr int kMostDropped = 8;

  struct Verdict {
    bool usable = false;
    bool replaced = false;   ///< `stamp` is the time of arrival
    bool restarted = false;  ///< the device's sequence number was not above the one before
    Stamp stamp{};
    std::uint64_t sequence = 0;  ///< as it is to be handed on
    std::uint64_t missing = 0;   ///< images between this one and the one before in the same stream
  };

  /// The next image is the first of a new stream.
  void begin_stream();
  /// A damaged image takes up a sequence number as well, which is then not missing.
  void corrupt() { ++corrupt_; }
  /// An image as the device numbered and stamped it, on CLOCK_MONOTONIC, looked at `now`.
  Verdict judge(std::uint64_t sequence, Stamp stamp, Clock::time_point now);

 private:
  void judge_sequence(std::uint64_t sequence, Verdict& verdict);
  void judge_stamp(Stamp stamp, Clock::time_point now, Verdict& verdict);

  std::optional<std::uint64_t> device_sequence_;  // of the image before, in this stream
  std::uint64_t corrupt_ = 0;                     // since then
  std::uint64_t sequence_ = 0;                    // handed on last, or 0
  bool any_ = false;                              // one was handed on
  std::optional<Stamp> newest_;
  int dropped_in_a_row_ = 0;
};

}  // namespace azimuth
