#pragma once
#include <string>

#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// The landmarks as a table with one line each. The first columns are those of landmarks.csv in run folders; further
/// columns contain the properties of the landmark and the covariance of its coordinates. Numbers are written without
/// loss. Unknown values are empty.
std::string map_csv(const MapSnapshot& map);

}  // namespace azimuth
