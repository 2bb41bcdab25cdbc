#pragma once
#include <cstdint>
#include <string>

#include "slam/estimator/estimate.hpp"

namespace azimuth {

/// A hash of a whole run. Two runs have the same digest when all their estimates are the same to the last bit and, for
/// all practical purposes, only then.
///
/// The hash is chained over stamp, pose, covariance and landmarks of every step. Predictions between steps are left
/// out, since their number depends on when samples arrive.
///
/// Thread contract: thread-bound. add() does not allocate.
class EstimateDigest {
 public:
  /// Adds the estimate to the digest, unless it is only predicted.
  void add(const Estimate& estimate);

  std::uint64_t value() const { return value_; }
  std::uint64_t estimates() const { return estimates_; }  ///< Number of estimates added so far

 private:
  void mix(std::uint64_t word);
  void mix(double value);

  std::uint64_t value_ = 0;
  std::uint64_t estimates_ = 0;
};

/// The digest as 16 hexadecimal digits.
std::string digest_text(std::uint64_t digest);

}  // namespace azimuth
