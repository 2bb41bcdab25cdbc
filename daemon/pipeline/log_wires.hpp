#pragma once
// The wires that lead to the recorders. A recorder may be as slow as its disk, so the writers never wait for room in
// these wires.

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

#include "daemon/pipeline/wires.hpp"
#include "daemon/record/frame_recorder.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// A sample on its way to the recorder. Samples come in the order in which the estimator took them.
struct TakenSample {
  bool is_odometry = false;  ///< False: the sample is a bearing set.
  OdometryReading odometry;
  BearingSet bearings;
};

/// A message on its way to the recorder.
struct SentMessage {
  std::string channel;
  std::vector<std::byte> data;
};

/// Capacities in samples and in messages. They bridge a few seconds of a slow disk.
inline constexpr std::size_t kTakenRing = 1024, kSentRing = 256;
/// Capacity in images of some megabytes each. It bridges half a second of a slow disk.
inline constexpr std::size_t kImagesRing = 8;

using TakenWire = EveryOne<TakenSample, kTakenRing>;
using SentWire = EveryOne<SentMessage, kSentRing>;
using ImagesWire = EveryOne<KeptImage, kImagesRing>;

/// Tells up to which stamp the poses have been published. The frame recorder waits for the pose at the stamp of each
/// image, so that it does not compete with the estimator for processors, caches and memory.
///
/// Thread contract: any thread may call tell() and newest().
class PosesOut {
 public:
  /// Each tell() rings `waiting`.
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
