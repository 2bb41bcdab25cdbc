#pragma once
#include <string>

namespace azimuth {

/// The form in which images are recorded, in addition to the bearings found in them.
enum class RecordedFrames {
  none,
  jpeg,  ///< compressed with loss; images that a camera sends as JPEG are kept unchanged
  raw    ///< exactly as the camera sent them
};

/// The contents of the log, its folder, and its disk space. A megabyte is 10^6 bytes.
struct RecordSettings {
  std::string folder;             ///< each start makes a session folder in it; empty: nothing is recorded
  std::string channel_prefix;     ///< put before every channel name, as in PublishSettings
  double max_file_mb = 256.0;     ///< a segment that reaches this size is closed
  double max_file_age_s = 600.0;  ///< a segment that reaches this age is closed
  /// Limit of all sessions in `folder` together; the oldest segments are deleted to keep it. 0: no quota.
  double quota_mb = 8000.0;
  /// Space to leave free on the disk. Old segments are deleted to keep it free; if that is not enough, recording stops.
  double min_free_mb = 500.0;
  /// When the process dies, at most the data of this interval are lost.
  double flush_interval_s = 0.2;
  RecordedFrames frames = RecordedFrames::none;
  double frames_rate_hz = 0.0;      ///< largest image rate; 0: every processed image
  int frames_quality = 90;          ///< JPEG quality, 1 to 100
  double frames_quota_mb = 8000.0;  ///< limit of the images of all sessions, in addition to quota_mb; 0: no quota
};

}  // namespace azimuth
