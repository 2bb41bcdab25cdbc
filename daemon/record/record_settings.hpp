#pragma once
#include <string>

namespace azimuth {

/// In which form images are recorded, beside what was found in them.
enum class RecordedFrames {
  none,
  jpeg,  ///< compressed, at a loss; those of a camera that sends JPEG as they came
  raw    ///< as the camera sent them, to the last bit
};

/// What is recorded, where, and how much disk it may take. Megabytes are 10^6 bytes.
struct RecordSettings {
  std::string folder;             ///< one session folder in it for each start; empty: nothing is recorded
  std::string channel_prefix;     ///< before every channel's name, as in PublishSettings
  double max_file_mb = 256.0;     ///< a segment that has grown to this size is closed
  double max_file_age_s = 600.0;  ///< likewise
  double quota_mb = 8000.0;       ///< all sessions in `folder` together, the oldest segments giving way; 0: no quota
  double min_free_mb = 500.0;     ///< left free on the disk: old segments give way, then recording stops
  double flush_interval_s = 0.2;  ///< the most that the death of the process loses
  RecordedFrames frames = RecordedFrames::none;
  double frames_rate_hz = 0.0;      ///< images a second at most; 0: every one that was looked at
  int frames_quality = 90;          ///< of the JPEG, 1 to 100
  double frames_quota_mb = 8000.0;  ///< images of all sessions together, beside quota_mb; 0: no quota
};

}  // namespace azimuth
