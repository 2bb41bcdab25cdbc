#pragma once
#include <cstddef>

#include "slam/perception/colour/scan.hpp"

// The AVX2 variant of find_runs() in scan.hpp; only for processors with AVX2.
namespace azimuth::avx2 {

std::size_t find_runs(const Scan& scan, const VisibleSpan* spans, std::size_t count, ColourRun* out, std::size_t room);

}  // namespace azimuth::avx2
