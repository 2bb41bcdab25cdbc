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

/// An image on its way to the log. The camera has its own back by then: however slow the disk, it never runs out of
/// buffers.
struct KeptImage {
  Stamp stamp{};
  FrameFormat format{};
  std::vector<std::byte> bytes = {};  ///< none: it could not be read
};

/// Records images in the session that a Recorder has begun, in segments of their own (FOLDER/SESSION/frames/000.lcm)
/// under a quota of their own: however large, they never push a sample out of the log, and they leave the disk to the
/// samples when it fills up. See SegmentedLog for what survives, and for disks in trouble.
///
/// Thread contract: thread-bound; not for real-time threads. Nothing of ours allocates once storage has grown.
class FrameRecorder {
 public:
  using Clock = SegmentedLog::Clock;

  /// `times` begin as those of the samples.
  FrameRecorder(const RecordSettings& settings, EventTimes times);

  /// The name of the session, without which every image is lost. Only the first counts.
  void begin(const std::string& session);

  void image(const KeptImage& image);
  /// To be called several times a flush interval.
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
