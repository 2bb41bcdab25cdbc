#pragma once
#include <string>

namespace azimuth {

/// Pictures of what perception saw and the estimator expected, for people.
struct PictureSettings {
  double rate_hz = 0.0;  ///< at most so many; 0: none are made
  std::string file;      ///< where the newest is written as JPEG; empty: nowhere
  bool publish = true;   ///< over LCM as well
  int quality = 80;      ///< of the JPEG, 1 to 100
};

}  // namespace azimuth
