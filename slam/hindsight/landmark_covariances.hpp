#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>

#include "slam/hindsight/mapper.hpp"

namespace azimuth {

/// How uncertain landmarks are, for what is said after each image. One takes some microseconds, so of a large map some
/// are computed anew with each image, and all in turn: what is known of a landmark hardly changes within seconds.
///
/// Thread contract: thread-bound.
class LandmarkCovariances {
 public:
  /// Up to so many are computed when they are asked for, as of the moment.
  static constexpr std::size_t kEachTime = 256;

  /// An image has been used: computes the next ones, when there are many. All are points.
  void refresh(std::span<const HindsightLandmark> landmarks, const Smoother& smoother);
  /// Of (x, y) in the map [m^2], as of the last few images.
  Eigen::Matrix2d of(const HindsightLandmark& landmark, const Smoother& smoother) const;
  /// The map has become another.
  void forget() { kept_.clear(); }

 private:
  struct Kept {
    LandmarkId in_graph = kOfNothing;
    Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
  };
  std::unordered_map<std::int64_t, Kept> kept_;  // by the landmarks' ids
  std::size_t next_ = 0;                         // whose turn it is
};

}  // namespace azimuth
