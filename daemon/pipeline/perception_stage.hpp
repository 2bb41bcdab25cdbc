#pragma once
#include <chrono>
#include <cstddef>
#include <memory>
#include <vector>

#include "daemon/pipeline/paces.hpp"
#include "daemon/publish/status.hpp"
#include "drivers/camera/frame.hpp"
#include "drivers/camera/jpeg.hpp"
#include "slam/perception/perception.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Turns camera frames into bearings: it decodes compressed frames and hands the images to a front end.
///
/// Thread contract: thread-bound. This code allocates nothing in the steady state; libjpeg allocates working memory for
/// each compressed frame.
class PerceptionStage {
 public:
  using Clock = std::chrono::steady_clock;

  /// `decoded` is the pixel format into which compressed frames are decoded: gray8, rgb8 or bgr8.
  PerceptionStage(std::unique_ptr<Perception> perception, PixelFormat decoded);

  /// Replaces the contents of `out` by the bearings found in the frame, with the frame's stamp and sequence number. A
  /// frame that cannot be decoded gives no bearings; `out.trouble` then names the cause.
  void observe(const Frame& frame, BearingSet& out);

  /// Counts and timing of the frames observed so far.
  const PerceptionStatus& status() const { return status_; }
  /// True: the status is to be published now, once a second and whenever the trouble has changed. A call that returns
  /// true starts the next interval.
  bool is_news(Clock::time_point now);

 private:
  ImageView uncompressed(const Frame& frame);
  void account(ImageTrouble trouble, Clock::duration detect);

  ImageStage images_;
  PixelFormat decoded_;
  JpegDecoder decoder_;
  std::vector<std::byte> jpeg_;
  PerceptionStatus status_;
  double detect_sum_us_ = 0.0;  // sum since the last report
  std::uint64_t detected_ = 0;
  StatusPace<ImageTrouble> pace_;
};

}  // namespace azimuth
