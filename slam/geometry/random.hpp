#pragma once
// Random numbers that are equal on every platform. The standard fixes the bits of its generators, but not the results
// of its distributions.
//
// Thread contract of all classes: thread-bound. The same seed gives the same numbers.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "slam/geometry/index.hpp"

namespace azimuth {

/// 2^64 divided by the golden ratio, made odd. Its multiples are far apart.
inline constexpr std::uint64_t kGoldenBits = 0x9e3779b97f4a7c15U;

/// The finaliser of splitmix64: a bijection in which every bit of the word affects every bit of the result.
constexpr std::uint64_t mixed_bits(std::uint64_t word) {
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9U;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebU;
  return word ^ (word >> 31);
}

/// The generator splitmix64, with one word of state; any seed is valid.
class SplitMix {
 public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}

  std::uint64_t operator()() { return mixed_bits(state_ += kGoldenBits); }
  /// Returns an index in [0, count); `count` must be positive and below 2^32.
  std::size_t index(std::size_t count) { return as_size((((*this)() >> 32) * count) >> 32); }

 private:
  std::uint64_t state_;
};

/// The generator xoshiro256++ by Blackman & Vigna: better statistical quality at the same speed.
class Xoshiro {
 public:
  explicit Xoshiro(std::uint64_t seed) {
    SplitMix words(seed);  // the state is never all zero, whatever the seed
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

/// Distributions that use the words of a generator: one of the above, or std::mt19937_64.
template <class Bits>
class RandomNumbers {
 public:
  explicit RandomNumbers(Bits bits) : bits_(std::move(bits)) {}

  /// Uniform in [0, 1), with 53 random bits.
  double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Gaussian of mean 0; `sigma` may be 0. The number of words drawn does not depend on sigma. Marsaglia's polar method
  /// makes two independent normals from a point in the unit disc; the second is kept for the next call.
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
