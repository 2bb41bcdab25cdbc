#pragma once
// What unpacking and searching may cost, by what was given: a file of some hundred bytes can hold chunks that unpack to
// gigabytes.

#include <algorithm>
#include <cstdint>

namespace azimuth {

/// Whatever is given may unpack to this.
inline constexpr std::uint64_t kFreeUnpackingBytes = std::uint64_t{32} << 20U;
/// And to so many times its size: odometry packs to a twentieth, a still image in a row of the same to less.
inline constexpr std::uint64_t kUnpackingRatio = 64;
/// What it is worth to ask whether a record begins at a byte that is in none: unpacking a byte takes less than that.
inline constexpr std::uint64_t kLookingForARecord_B = 8;

/// One file's, over all of its chunks. Work is counted in bytes, those read, those made and those searched for a record
/// where none is, so that the same file ends the same way on any machine.
///
/// Thread contract: thread-bound.
class UnpackBudget {
 public:
  explicit UnpackBudget(std::uint64_t given_B) : left_B_(kFreeUnpackingBytes + kUnpackingRatio * given_B) {}

  /// False from the first time on that it does not suffice.
  bool spend(std::uint64_t bytes) {
    is_overdrawn_ = is_overdrawn_ || bytes > left_B_;
    left_B_ -= std::min(bytes, left_B_);
    return !is_overdrawn_;
  }
  bool is_overdrawn() const { return is_overdrawn_; }

 private:
  std::uint64_t left_B_;
  bool is_overdrawn_ = false;
};

}  // namespace azimuth
