#pragma once
// What goes to the recorders. They may be as slow as a disk: who writes into these wires waits for nobody.

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

#include "daemon/pipeline/wires.hpp"
#include "daemon/record/frame_recorder.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// A sample on its way to the recorder, in the order in which the estimator took them.
struct TakenSample {
  bool is_odometry = false;  ///< else bearings
  OdometryReading odometry;
  BearingSet bearings;
};

/// A message on its way to the recorder.
struct SentMessage {
  std::string channel;
  std::vector<std::byte> data;
};

inline constexpr std::size_t kTakenRing = 1024, kSentRing = 256;  ///< seconds of a slow disk
inline constexpr std::size_t kImagesRing = 8;                     ///< megabytes each: half a second of it

using TakenWire = EveryOne<TakenSample, kTakenRing>;
using SentWire = EveryOne<SentMessage, kSentRing>;
using ImagesWire = EveryOne<KeptImage, kImagesRing>;

/// Up to which sample the poses are out. Who only records an image waits for that of the image, so as not to compete
/// with it for processors, caches and memory.
///
/// Thread contract: any thread may tell and ask.
class PosesOut {
 public:
  /// `waiting` is rung for each.
  explicit PosesOut(Doorbell& waiting) : waiting_(waiting) {}

  void tell(Stamp newest) noexcept {
    newest_.store(newest, std::memory_order_release);
    waiting_.ring();
  }
  Stamp newest() const noexcept { return newest_.load(std::memory_order_acquire); }

 private:
  Doorbell& waiting_;
  std::atomic<Stamp> newest_{Stamp::min()};
};

}  // namespace azimuth
