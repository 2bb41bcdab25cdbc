#pragma once
// Vectors of AZIMUTH_LANES doubles, for loops that are included once for each instruction set they are compiled for.
// Everything in such a header has internal linkage and uses nothing of the standard library, so that the linker cannot
// mix code for different processors.

#include <Eigen/Core>

#ifndef AZIMUTH_LANES
#define AZIMUTH_LANES 2
#endif

namespace azimuth {
namespace {

using Index = Eigen::Index;
// NOLINTBEGIN(misc-definitions-in-headers): a copy for each instruction set is intended
constexpr Index kLanes = AZIMUTH_LANES;
using Lanes = double __attribute__((vector_size(8 * kLanes)));
using LanesAnywhere [[gnu::aligned(8), gnu::may_alias]] = Lanes;  // unaligned, in memory
// NOLINTEND(misc-definitions-in-headers)

// Not memcpy: GCC for arm64 compiles it to a detour through the stack.
inline void load(Lanes& value, const double* from) { value = *reinterpret_cast<const LanesAnywhere*>(from); }

inline void store(double* to, const Lanes& value) { *reinterpret_cast<LanesAnywhere*>(to) = value; }

}  // namespace
}  // namespace azimuth
