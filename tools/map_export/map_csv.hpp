#pragma once
#include <string>

#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// The landmarks as a table, one a line: what landmarks.csv of a run folder begins with, then what is known of each,
/// with the covariance of its own coordinates. Doubles keep every bit; what is not known is empty.
std::string map_csv(const MapSnapshot& map);

}  // namespace azimuth
