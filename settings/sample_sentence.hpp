#pragma once
#include <string>

#include "slam/estimator/sample_watch.hpp"

namespace azimuth {

/// One sentence for a person: what is wrong with the samples, the likely cause, and the key or column to look at. Empty
/// when nothing is.
std::string sentence(const SampleFinding& finding);

}  // namespace azimuth
