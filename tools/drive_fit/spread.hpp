#pragma once
#include <cstddef>
#include <vector>

#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

/// The ends of ten parts with about as many bearings, as numbers of places.
std::vector<std::size_t> ends_of_parts(const DriveGraph& graph);

/// How uncertain the numbers of a solution are: covariance of numbers_of(guess).
///
/// Two answers, of which each number gets the larger one. The graph's own takes the rig's noise for true, and errors
/// for independent of each other. The other takes neither: the drive is cut into ten parts of as many bearings, each is
/// left out in turn, and what that changes tells how far the parts agree (the jackknife over groups; SPEC VI.25).
Eigen::Matrix<double, kCalibrations, kCalibrations> spread_of(const Drive& drive, const DriveSolution& solution,
                                                              const FreeErrors& free,
                                                              const HindsightSettings& settings);

}  // namespace azimuth
