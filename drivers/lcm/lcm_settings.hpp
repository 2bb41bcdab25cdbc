#pragma once
#include <string>

namespace azimuth {

/// What the time of a sample that came over LCM is taken from.
enum class LcmStampKind {
  sender,  ///< its utime: by the wall clock of this machine
  receipt  ///< its arrival at the kernel: for senders with clocks of their own, e.g. a log being played
};

/// Samples that another process sends over LCM.
struct LcmSourceSettings {
  std::string url = "udpm://239.255.76.67:7667";
  std::string frames_channel = "CAMERA";      ///< image_t, as of bot_core
  std::string odometry_channel = "ODOMETRY";  ///< odometry_t, or pose_t as of bot_core
  LcmStampKind stamps = LcmStampKind::sender;
  double max_age_s = 1.0;     ///< a sample whose stamp is older at its arrival is dropped
  double max_frame_mb = 4.0;  ///< larger images are dropped; memory is set aside for some of that size
  double silent_s = 1.0;      ///< a sender that sends nothing for so long is in trouble, and another may take over
};

}  // namespace azimuth
