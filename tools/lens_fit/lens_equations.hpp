#pragma once
// Internal to tools/lens_fit and its test.

#include "tools/lens_fit/lens_fit.hpp"
#include "tools/lens_fit/robust_fit.hpp"

namespace azimuth {

/// Unknowns: the kThroughout global numbers, then (x, y, heading) of each frame, then (x, y, height) of each lamp.
using LensEquations = FitEquations;

LensEquations lens_equations(const LensDrive& drive, const LensSolution& at, const LensSolution& start,
                             const LensPriors& priors);
LensSolution lens_moved(LensSolution from, const Eigen::VectorXd& by);

/// (x, y, heading) of the end pose relative to the start pose, and its derivatives.
struct RelativePose {
  Eigen::Vector3d value;
  Eigen::Matrix3d by_start, by_end;
};
RelativePose relative_pose(const Pose2& T_map_start, const Pose2& T_map_end);

}  // namespace azimuth
