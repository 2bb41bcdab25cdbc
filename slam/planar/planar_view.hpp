#pragma once
#include <limits>
#include <optional>

#include "slam/camera/camera_rig.hpp"
#include "slam/ekf/bearing_ekf.hpp"
#include "slam/planar/planar_landmark.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Predicts how the camera sees the landmarks of the planar filter from the robot's estimated pose.
///
/// Thread contract: reentrant. Refers to filter and camera, and follows their changes.
class PlanarView {
 public:
  PlanarView(const BearingEkf& ekf, const CameraRig& camera, double reach_m = std::numeric_limits<double>::infinity())
      : ekf_(ekf), camera_(camera), reach_m_(reach_m) {}

  const BearingEkf& ekf() const { return ekf_; }
  const CameraRig& camera() const { return camera_; }

  /// Whether a landmark that looks like others is near enough to be associated with a bearing.
  bool reaches(const PlanarLandmark& landmark) const {
    if (!landmark.is_point()) return true;
    return (ekf_.state().position(landmark.block) - ekf_.state().pose().position()).norm() < reach_m_;
  }

  /// The noise variance of a bearing, its own or the rig's [rad^2].
  double variance_rad2(const Bearing& bearing) const;
  MappedSighting sighting_of(const PlanarLandmark& landmark, const Bearing& bearing) const;

  /// A predicted bearing of a landmark.
  struct Predicted {
    ObservationRow row;
    double azimuth_rad;    ///< in the camera's frame
    double variance_rad2;  ///< Variance of the azimuth, including what a linear prediction leaves out
  };
  /// Nothing when the landmark is too near. The distance from the image's centre is taken from its last bearing, which
  /// is accurate enough for the small effect of the centre's error.
  std::optional<Predicted> predict(const PlanarLandmark& landmark) const;

  /// h(x) and H P H^T for a bearing with the rig's noise, without the effect of the image's centre (mathematics I.6,
  /// I.7).
  std::optional<Predicted> predict_straight(const PlanarLandmark& landmark) const;

 private:
  const BearingEkf& ekf_;
  const CameraRig& camera_;
  double reach_m_;
};

}  // namespace azimuth
