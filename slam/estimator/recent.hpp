#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>

namespace azimuth {

/// How often a condition held in its last 64 evaluations. Thread contract: thread-bound.
class Recent {
 public:
  void add(bool held) {
    bits_ = bits_ << 1U | (held ? 1U : 0U);
    asked_ = std::min(asked_ + 1, 64);
  }
  int asked() const { return asked_; }
  int held() const { return std::popcount(bits_); }
  bool mostly() const { return 2 * held() > asked_; }

 private:
  std::uint64_t bits_ = 0;
  int asked_ = 0;
};

}  // namespace azimuth
