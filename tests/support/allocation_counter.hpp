#pragma once
// Counts every allocation of the process, by operator new or (as Eigen does) by malloc.

#include <cstddef>

namespace azimuth {

/// Number of allocations of this thread since the program started.
std::size_t allocations();

}  // namespace azimuth
