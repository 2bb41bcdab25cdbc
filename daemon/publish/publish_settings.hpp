#pragma once
#include <string>

namespace azimuth {

/// The messages that are sent, their address and their rates.
struct PublishSettings {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";  ///< ttl 0: this machine only
  std::string channel_prefix;                               ///< put before every channel name
  double map_rate_hz = 1.0;                                 ///< rate of the whole map; 0: only at the end
  bool echo_samples = true;                                 ///< send AZIMUTH_ODOM, _BEARINGS and _FEATURES
  /// Print a line on standard output for the pose of each step.
  bool print_poses = false;
};

/// Pictures for people of the detected and the expected bearings.
struct PictureSettings {
  double rate_hz = 0.0;  ///< at most this rate; 0: no pictures
  std::string file;      ///< the newest picture is written to this file as JPEG; empty: no file
  bool publish = true;   ///< send the pictures over LCM as well
  int quality = 80;      ///< JPEG quality, 1 to 100
};

}  // namespace azimuth
