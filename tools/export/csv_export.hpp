#pragma once
#include <string>

#include "tools/export/estimated.hpp"

namespace azimuth {

/// A table, a line for each pose: time, pose, its covariance, calibrated odometry, health and its reason. Columns have
/// the names of run folders' tables, so that `azimuth import` reads it; doubles keep every bit; what is not known is
/// empty, and quotes stand round a reason with a comma in it.
std::string poses_csv(const Estimated& estimated);

}  // namespace azimuth
