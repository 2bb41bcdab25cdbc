#pragma once
#include <string>

#include "tools/evaluate/report.hpp"

namespace azimuth {

/// Whether this machine needs longer for a step, on the average, than images take to come: a daemon on it would leave
/// images out. In a sentence with the key to change; empty: it is quick enough, or nobody knows.
std::string why_too_slow(const Report& report);

}  // namespace azimuth
