#pragma once
#include <azimuth/image_t.hpp>
#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "daemon/record/event_times.hpp"
#include "daemon/record/record_settings.hpp"
#include "daemon/record/segmented_log.hpp"
#include "drivers/camera/jpeg.hpp"
#include "slam/sample/image.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// A copy of an image on its way to the log. The camera already has its buffer back, so a slow disk never leaves the
/// camera without buffers.
struct KeptImage {
  Stamp stamp{};
  FrameFormat format{};
  std::vector<std::byte> bytes = {};  ///< empty: the image could not be read
};

/// Records images in the session of a Recorder, in segments of their own (FOLDER/SESSION/frames/000.lcm) under a quota
/// of their own. So images never push samples out of the log, and when the disk fills up, image segments are deleted
/// first. SegmentedLog tells which data survive a failure, and what happens when the disk is in trouble.
///
/// Thread contract: thread-bound; not for real-time threads. This code allocates nothing once the storage has grown.
class FrameRecorder {
 public:
  using Clock = SegmentedLog::Clock;

  /// `times` starts at the same time as the EventTimes of the Recorder.
  FrameRecorder(const RecordSettings& settings, EventTimes times);

  /// Sets the name of the session. Before this call every image is lost. Only the first call has an effect.
  void begin(const std::string& session);

  void image(const KeptImage& image);
  /// Flushes the log and makes room. To be called several times per flush interval.
  void turn(Clock::time_point now) { log_.turn(now); }

  const RecorderStatus& status() const { return log_.status(); }
  double rate_hz() const { return rate_hz_; }

 private:
  ImageView compressed(const ImageView& image);

  std::string channel_;
  RecordedFrames form_;
  double rate_hz_;
  int quality_;
  EventTimes times_;
  SegmentedLog log_;
  bool begun_ = false;
  JpegEncoder encoder_;
  cv::Mat rgb_;
  image_t message_{};
  std::vector<std::byte> data_;
};

}  // namespace azimuth
