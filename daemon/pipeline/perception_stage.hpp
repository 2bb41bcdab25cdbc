#pragma once
#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

#include "daemon/pipeline/paces.hpp"
#include "daemon/publish/status.hpp"
#include "drivers/camera/frame.hpp"
#include "drivers/camera/jpeg.hpp"
#include "slam/perception/image_stage.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// From frames as cameras send them to bearings: decodes what is compressed and hands it to a front end.
///
/// Thread contract: thread-bound. Of ours nothing allocates in the steady state; libjpeg's working memory comes and
/// goes with each compressed frame.
class PerceptionStage {
 public:
  using Clock = std::chrono::steady_clock;

  /// Compressed frames are decoded to `decoded`: gray8, rgb8 or bgr8.
  PerceptionStage(std::unique_ptr<Perception> perception, PixelFormat decoded);

  /// Replaces what `out` holds by what the frame shows, with the frame's stamp and sequence. A frame that cannot be
  /// decoded gives no bearings and says why, as Perception does.
  void observe(const Frame& frame, BearingSet& out);

  /// What became of the frames so far.
  const PerceptionStatus& status() const { return status_; }
  /// Whether that is news: once a second, and whenever the trouble has changed. The next second begins then.
  bool is_news(Clock::time_point now);

 private:
  ImageView uncompressed(const Frame& frame);
  void account(ImageTrouble trouble, Clock::duration detect);

  ImageStage images_;
  PixelFormat decoded_;
  JpegDecoder decoder_;
  std::vector<std::byte> jpeg_;
  PerceptionStatus status_;
  double detect_sum_us_ = 0.0;  // since the last report
  std::uint64_t detected_ = 0;
  StatusPace<ImageTrouble> pace_;
};

}  // namespace azimuth
