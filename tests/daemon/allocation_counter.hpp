#pragma once
// Counts the heap allocations of certain threads, selected by their names, while armed. allocation_counter.cpp must be
// linked into the test program; it replaces malloc and its relatives.

#include <cstdint>

namespace azimuth::test {

/// False under sanitizers, which replace the heap themselves.
bool can_count_allocations();

/// Starts to count the allocations of the threads named "player", "perception" and "estimator".
void arm_allocation_counter();
void disarm_allocation_counter();

std::uint64_t counted_allocations();
void reset_allocation_counter();

}  // namespace azimuth::test
