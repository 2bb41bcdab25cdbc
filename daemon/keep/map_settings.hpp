#pragma once
#include <string>

namespace azimuth {

/// The map that outlives the daemon. The estimator's table [map] configures how a start uses it.
struct MapSettings {
  std::string file;               ///< empty: no map is loaded or saved
  double save_interval_s = 30.0;  ///< 0: saved only on an orderly stop
  // After a restart, relocalisation is limited to the places that the robot can have reached since a recent map.
  double recent_s = 60.0;  ///< largest age of a recent map; 0: no map counts as recent
  /// Largest speed at which a robot drives indoors, or is carried.
  double fastest_m_per_s = 2.5;
};

}  // namespace azimuth
