#pragma once
#include <string>

namespace azimuth {

/// What is sent, where and how often.
struct PublishSettings {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";  ///< ttl 0: this machine only
  std::string channel_prefix;                               ///< before every channel's name
  double map_rate_hz = 1.0;                                 ///< the whole map, in chunks; 0: only at the end
  bool echo_samples = true;                                 ///< AZIMUTH_ODOM, AZIMUTH_BEARINGS and AZIMUTH_FEATURES
  bool print_poses = false;                                 ///< a line on standard output for each pose of a step
};

/// Pictures of what perception saw and the estimator expected, for people.
struct PictureSettings {
  double rate_hz = 0.0;  ///< at most so many; 0: none are made
  std::string file;      ///< where the newest is written as JPEG; empty: nowhere
  bool publish = true;   ///< over LCM as well
  int quality = 80;      ///< of the JPEG, 1 to 100
};

}  // namespace azimuth
