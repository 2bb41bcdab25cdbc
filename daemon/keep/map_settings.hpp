#pragma once
#include <string>

namespace azimuth {

/// The map that outlives the daemon. How it starts from one is the estimator's configuration: the table [map].
struct MapSettings {
  std::string file;               ///< empty: nothing is loaded or saved
  double save_interval_s = 30.0;  ///< 0: only on an orderly stop
};

}  // namespace azimuth
