#pragma once
// Internal to drivers/camera.

#include <chrono>
#include <cstdint>
#include <optional>

#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Judges the stamps and sequence numbers of one camera's images over all its streams, so that the delivered ones
/// strictly increase.
///
/// Thread contract: thread-bound. Nothing allocates.
class ImageOrder {
 public:
  using Clock = std::chrono::steady_clock;
  /// Tolerance for stamps in the future: the kernel's clock may be read slightly later than `now`.
  static constexpr Duration kFuture{2'000};
  /// Largest plausible age of an image. An image takes longer from exposure to this process only if the process was
  /// suspended.
  static constexpr Duration kOldest{2'000'000};
  /// After this many consecutive unusable stamps the device evidently uses another clock. From then on the time of
  /// arrival replaces its stamps, which is worse than a stamp but better than no image.
  static constexpr int kMostDropped = 8;

  struct Verdict {
    bool usable = false;
    bool replaced = false;  ///< `stamp` is the time of arrival
    /// The device's sequence number was not greater than the previous one.
    bool restarted = false;
    Stamp stamp{};
    std::uint64_t sequence = 0;  ///< the number to deliver
    std::uint64_t missing = 0;   ///< images missing since the previous image of this stream
  };

  /// Announces that the next image is the first of a new stream.
  void begin_stream();
  /// Records a damaged image. It consumes a sequence number, which then does not count as missing.
  void corrupt() { ++corrupt_; }
  /// Judges an image by the device's number and its stamp on CLOCK_MONOTONIC, at the time `now`.
  Verdict judge(std::uint64_t sequence, Stamp stamp, Clock::time_point now);

 private:
  void judge_sequence(std::uint64_t sequence, Verdict& verdict);
  void judge_stamp(Stamp stamp, Clock::time_point now, Verdict& verdict);

  std::optional<std::uint64_t> device_sequence_;  // number of the previous image in this stream
  std::uint64_t corrupt_ = 0;                     // damaged images since the previous good one
  std::uint64_t sequence_ = 0;                    // the number delivered last, or 0
  bool any_ = false;                              // an image has been delivered
  std::optional<Stamp> newest_;
  int dropped_in_a_row_ = 0;
};

}  // namespace azimuth
