#pragma once
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The stamp `seconds` after the epoch.
inline Stamp at_s(double seconds) { return Stamp{duration_from_seconds(seconds)}; }

}  // namespace azimuth
