#pragma once
#include <string>

#include "tools/evaluate/report.hpp"

namespace azimuth {

/// A sentence, with the key to change, if the mean duration of a step exceeds the interval between images, so that a
/// daemon on this machine would skip images. Empty if the machine is fast enough or if this is unknown.
std::string why_too_slow(const Report& report);

}  // namespace azimuth
