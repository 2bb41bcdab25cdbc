#pragma once
#include <string>

#include "tools/export/estimated.hpp"

namespace azimuth {

/// A table with one line per pose: time, pose, covariance, calibrated odometry, health and its reason. Column names are
/// those of run folders, so that `azimuth import` reads the table. Numbers are written without loss. Unknown values are
/// empty. A reason that contains a comma is quoted.
std::string poses_csv(const Estimated& estimated);

}  // namespace azimuth
