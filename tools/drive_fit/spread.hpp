#pragma once
#include <cstddef>
#include <vector>

#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

/// Splits the drive into ten parts with about equally many bearings. Returns the end of each part as a place index.
std::vector<std::size_t> ends_of_parts(const DriveGraph& graph);

/// Covariance of numbers_of(guess) of a solution.
///
/// Each number gets the larger of two variances. The variance of the graph assumes that the rig's noise is correct and
/// that errors are independent. The second variance assumes neither: it results from a grouped jackknife, which leaves
/// out each of the ten parts in turn (mathematics VI.25).
Eigen::Matrix<double, kCalibrations, kCalibrations> spread_of(const Drive& drive, const DriveSolution& solution,
                                                              const FreeErrors& free,
                                                              const HindsightSettings& settings);

}  // namespace azimuth
