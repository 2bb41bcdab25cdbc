#pragma once
// Counts heap allocations of threads by their name, while armed. Link allocation_counter.cpp into the test program: it
// replaces malloc and its relatives.

#include <cstdint>

namespace azimuth::test {

/// False under sanitizers, which bring a heap of their own.
bool can_count_allocations();

/// From now on allocations of the threads named "player", "perception" and "estimator" count.
void arm_allocation_counter();
void disarm_allocation_counter();

std::uint64_t counted_allocations();
void reset_allocation_counter();

}  // namespace azimuth::test
