#pragma once
#include <cstdint>
#include <string>

#include "slam/estimator/estimate.hpp"

namespace azimuth {

/// One number for a whole run: two runs have the same digest when every estimate was the same to the last bit (and,
/// for all practical purposes, only then).
///
/// Chained over stamp, pose, covariance and landmarks of every step. Predictions between the steps are left out, since
/// how many there are depends on when samples arrive.
///
/// Thread contract: thread-bound. add() does not allocate.
class EstimateDigest {
 public:
  /// Takes the estimate in, unless it is only predicted.
  void add(const Estimate& estimate);

  std::uint64_t value() const { return value_; }
  std::uint64_t estimates() const { return estimates_; }  ///< taken in so far

 private:
  void mix(std::uint64_t word);
  void mix(double value);

  std::uint64_t value_ = 0;
  std::uint64_t estimates_ = 0;
};

/// 16 hexadecimal digits.
std::string digest_text(std::uint64_t digest);

}  // namespace azimuth
