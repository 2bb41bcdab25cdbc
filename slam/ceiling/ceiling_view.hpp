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

/// The usable directions of an image: those no farther from the zenith than the camera is to be trusted.
struct CeilingImage {
  std::vector<LampSeen> seen;
  std::vector<MeasuredDirection> measured;  ///< The same directions, in the form for matching
  std::vector<std::size_t> bearing_of;      ///< For each direction, the index of its bearing in the image
  std::size_t lights = 0;                   ///< Number of directions before LampMatcher left some out
  bool crowded = false;                     ///< Whether there were more directions than LampEkfSettings::max_directions
  bool without_elevation = false;           ///< Whether there were bearings but none with an elevation

  /// Copies the direction at index `from` to index `to`, where `to` <= `from`.
  void move(std::size_t from, std::size_t to);
  /// Keeps the first `size` directions.
  void shorten(std::size_t size);
  void clear() { shorten(0); }
};

/// The predicted direction of a lamp.
struct PredictedDirection {
  std::size_t lamp;  ///< Index of the lamp
  PredictedLamp offset;
  Eigen::Matrix2d covariance;  ///< Covariance of the offset per metre of height
};

/// Field of view and detection model of a camera that looks up at lamps.
///
/// Thread contract: reentrant.
class CeilingView {
 public:
  CeilingView(const Rig& rig, const LampsInView& settings);

  double max_zenith_rad() const { return max_zenith_rad_; }
  double solid_angle_sr() const;
  /// Probability of detection of a lamp in the field of view; log_missed() is ln of the probability of a miss.
  double detection_probability() const { return detection_probability_; }
  double log_missed() const { return log_missed_; }
  const LampDirections& directions() const { return directions_; }

  /// Replaces the content of `out` with the usable directions of `bearings`. The estimated camera errors are subtracted
  /// from the directions, and their covariance is added to the noise.
  void measure(const BearingSet& bearings, const CameraErrors& camera, CeilingImage& out) const;

  /// Whether the lamp's absence from an image is significant: it is well inside the field of view, and its predicted
  /// direction is accurate.
  bool is_in_view(const PredictedDirection& predicted) const;
  /// Probability that an image does not show the lamp.
  double chance_of_miss(const PredictedDirection& predicted) const {
    return 1.0 - detection(predicted) * chance_of_view(predicted);
  }
  /// Probability of detection of the lamp if it is in the field of view. Near the rim, where the image may cut the
  /// lamp, the probability is half of the usual value.
  double detection(const PredictedDirection& predicted) const;

 private:
  double chance_of_view(const PredictedDirection& predicted) const;

  LampDirections directions_;
  double inner_margin_, max_zenith_rad_, detection_probability_, log_missed_;
};

}  // namespace azimuth
