#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>

#include "slam/hindsight/mapper.hpp"

namespace azimuth {

/// Covariances of the landmarks for the estimate after each image. One covariance takes some microseconds, so in a
/// large map each image recomputes only some of them, in turn; a landmark's covariance hardly changes within seconds.
///
/// Thread contract: thread-bound.
class LandmarkCovariances {
 public:
  /// Up to this number of landmarks, covariances are computed on request and are exact.
  static constexpr std::size_t kEachTime = 256;

  /// Must be called after an image was used. Recomputes the next covariances if there are many landmarks. All landmarks
  /// must be points.
  void refresh(std::span<const HindsightLandmark> landmarks, const Smoother& smoother);
  /// Covariance of (x, y) in the map [m^2], as of one of the last images.
  Eigen::Matrix2d of(const HindsightLandmark& landmark, const Smoother& smoother) const;
  /// Must be called when the map was replaced.
  void forget() { kept_.clear(); }

 private:
  struct Kept {
    LandmarkId in_graph = kOfNothing;
    Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
  };
  std::unordered_map<std::int64_t, Kept> kept_;  // by landmark id
  std::size_t next_ = 0;                         // next landmark to recompute
};

}  // namespace azimuth
