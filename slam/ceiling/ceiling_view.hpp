#pragma once
#include <cstddef>
#include <vector>

#include "slam/association/direction_matching.hpp"
#include "slam/ekf/lamp_ekf.hpp"
#include "slam/estimator/lamp_directions.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/fastslam/lamps_in_view.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The directions of use in an image: above the horizon, as far down as the camera is to be trusted.
struct CeilingImage {
  std::vector<LampSeen> seen;
  std::vector<MeasuredDirection> measured;  ///< the same, for matching
  std::vector<std::size_t> bearing_of;      ///< of each, in the image
  std::size_t lights = 0;                   ///< how many they were before some were left out
  bool crowded = false;                     ///< they were more than there is room for
  bool without_elevation = false;           ///< there were bearings, but none of use

  /// Puts the direction `from` in the place of `to`, which is not behind it.
  void move(std::size_t from, std::size_t to);
  /// Leaves the first `size` of them.
  void shorten(std::size_t size);
  void clear() { shorten(0); }
};

/// A lamp as the camera should see it.
struct PredictedDirection {
  std::size_t lamp;  ///< index
  PredictedLamp offset;
  Eigen::Matrix2d covariance;  ///< of the offset per metre
};

/// What a camera that looks up sees of lamps.
///
/// Thread contract: reentrant.
class CeilingView {
 public:
  CeilingView(const Rig& rig, const LampsInView& settings);

  double max_zenith_rad() const { return max_zenith_rad_; }
  double solid_angle_sr() const;
  /// That a lamp in view is seen, and ln of the probability that it is not.
  double detection_probability() const { return detection_probability_; }
  double log_missed() const { return log_missed_; }
  const LampDirections& directions() const { return directions_; }

  /// Replaces `out`, the camera's errors as estimated taken out and their uncertainty added to the noise.
  void measure(const BearingSet& bearings, const CameraErrors& camera, CeilingImage& out) const;

  /// Where its absence would say something: well inside the view, and known not too vaguely.
  bool is_in_view(const PredictedDirection& predicted) const;
  /// That an image does not show the lamp.
  double chance_of_miss(const PredictedDirection& predicted) const {
    return 1.0 - detection(predicted) * chance_of_view(predicted);
  }
  /// Of the lamp when it is in view. At the rim, where it may be cut, half of what is usual.
  double detection(const PredictedDirection& predicted) const;

 private:
  double chance_of_view(const PredictedDirection& predicted) const;

  LampDirections directions_;
  double inner_margin_, max_zenith_rad_, detection_probability_, log_missed_;
};

}  // namespace azimuth
