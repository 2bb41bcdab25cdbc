#pragma once
#include <span>
#include <string>
#include <string_view>

#include "slam/estimator/sample_watch.hpp"

namespace azimuth {

/// Returns one sentence for a person: what is wrong with the samples, the likely cause, and the key or column to look
/// at. The sentence is empty if the samples are right.
std::string sentence(const SampleFinding& finding);

/// Returns a sentence that says that the stamps of `what` do not fit those of the odometry: the two come from different
/// clocks, or one of the two is in another unit, which the sentence names.
std::string apart_sentence(const StampSpan& odometry, const StampSpan& other, std::string_view what);

/// Returns a sentence that says when an odometer begins anew, how far its pose jumps, and what is known of the robot's
/// motion in between. The sentence is empty if the odometer never begins anew.
std::string restart_sentence(std::span<const OdometryReading> readings);

}  // namespace azimuth
