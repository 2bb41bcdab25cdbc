#pragma once
#include <string>

namespace azimuth {

/// The origin of the stamps of samples received over LCM.
enum class LcmStampKind {
  sender,  ///< the message's utime, on the wall clock of this machine
  /// The time of arrival in the kernel: for senders with another clock, e.g. a log that is being played.
  receipt
};

/// The settings for samples that another process sends over LCM.
struct LcmSourceSettings {
  std::string url = "udpm://239.255.76.67:7667";
  std::string frames_channel = "CAMERA";      ///< bot_core's image_t
  std::string odometry_channel = "ODOMETRY";  ///< odometry_t, or bot_core's pose_t
  LcmStampKind stamps = LcmStampKind::sender;
  double max_age_s = 1.0;     ///< a sample whose stamp is older on arrival is dropped
  double max_frame_mb = 4.0;  ///< larger images are dropped; memory is reserved for several images of this size
  /// A sender that is silent for this long is reported as silent, and another sender may take over.
  double silent_s = 1.0;
};

}  // namespace azimuth
