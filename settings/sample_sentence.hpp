#pragma once
#include <span>
#include <string>
#include <string_view>

#include "slam/estimator/sample_watch.hpp"

namespace azimuth {

/// One sentence for a person: what is wrong with the samples, the likely cause, and the key or column to look at. Empty
/// when nothing is.
std::string sentence(const SampleFinding& finding);

/// That `what`, samples of other times than the odometry, do not fit it: two clocks, or which of the two is in which
/// unit.
std::string apart_sentence(const StampSpan& odometry, const StampSpan& other, std::string_view what);

/// Where an odometer begins anew, how far from where it was, and what is known of the robot's motion meanwhile; empty:
/// nowhere.
std::string restart_sentence(std::span<const OdometryReading> readings);

}  // namespace azimuth
