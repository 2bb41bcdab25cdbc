#pragma once
#include <string>

namespace azimuth {

/// The map that outlives the daemon. How it starts from one is the estimator's configuration: the table [map].
struct MapSettings {
  std::string file;               ///< empty: nothing is loaded or saved
  double save_interval_s = 30.0;  ///< 0: only on an orderly stop
  // Where a robot is looked for whose daemon was restarted: not far, if its map is recent.
  double recent_s = 60.0;        ///< a map is, up to this age; 0: none is
  double fastest_m_per_s = 2.5;  ///< that a robot drives indoors, or is carried
};

}  // namespace azimuth
