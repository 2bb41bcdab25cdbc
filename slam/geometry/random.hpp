#pragma once
// Random numbers that are the same on every platform: the standard fixes the bits of its generators, but not what its
// distributions make of them.
//
// Thread contract of all: thread-bound. The same seed gives the same numbers.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "slam/geometry/index.hpp"

namespace azimuth {

/// 2^64 over the golden ratio, odd: its multiples are far apart.
inline constexpr std::uint64_t kGoldenBits = 0x9e3779b97f4a7c15U;

/// Every bit of the word reaches every bit of the result, which no other word has (the finaliser of splitmix64).
constexpr std::uint64_t mixed_bits(std::uint64_t word) {
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9U;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebU;
  return word ^ (word >> 31);
}

/// splitmix64: one word of state, any seed.
class SplitMix {
 public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}

  std::uint64_t operator()() { return mixed_bits(state_ += kGoldenBits); }
  /// In [0, count); `count` positive and below 2^32.
  std::size_t index(std::size_t count) { return as_size((((*this)() >> 32) * count) >> 32); }

 private:
  std::uint64_t state_;
};

/// xoshiro256++ by Blackman & Vigna: better bits, and as quick.
class Xoshiro {
 public:
  explicit Xoshiro(std::uint64_t seed) {
    SplitMix words(seed);  // no seed leaves all four at zero
    for (std::uint64_t& word : state_) word = words();
  }

  std::uint64_t operator()() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

 private:
  std::array<std::uint64_t, 4> state_;
};

/// Distributions over the words of a generator: one of the above, or std::mt19937_64.
template <class Bits>
class RandomNumbers {
 public:
  explicit RandomNumbers(Bits bits) : bits_(std::move(bits)) {}

  /// In [0, 1), 53 random bits.
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Gaussian of mean 0; `sigma` may be 0. Draws the same amount whatever sigma is. By Marsaglia's polar method: two
  /// independent normals from a point in the unit disc.
  double normal(double sigma = 1.0) {
    if (std::exchange(has_spare_, false)) return sigma * spare_;
    double x = 0.0, y = 0.0, square = 0.0;
    do {
      x = uniform(-1.0, 1.0);
      y = uniform(-1.0, 1.0);
      square = x * x + y * y;
    } while (square >= 1.0 || square == 0.0);
    const double scale = std::sqrt(-2.0 * std::log(square) / square);
    spare_ = y * scale;
    has_spare_ = true;
    return sigma * x * scale;
  }

 private:
  Bits bits_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace azimuth
