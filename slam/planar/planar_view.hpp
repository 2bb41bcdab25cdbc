#pragma once
#include <limits>
#include <optional>

#include "slam/camera/camera_rig.hpp"
#include "slam/ekf/bearing_ekf.hpp"
#include "slam/planar/planar_landmark.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// How the camera sees the landmarks of the planar filter from where the robot is believed to be.
///
/// Thread contract: reentrant. Borrows filter and camera, and follows what becomes of them.
class PlanarView {
 public:
  PlanarView(const BearingEkf& ekf, const CameraRig& camera, double reach_m = std::numeric_limits<double>::infinity())
      : ekf_(ekf), camera_(camera), reach_m_(reach_m) {}

  const BearingEkf& ekf() const { return ekf_; }
  const CameraRig& camera() const { return camera_; }

  /// Whether a landmark that looks like others is near enough to be the one that is seen.
  bool reaches(const PlanarLandmark& landmark) const {
    if (!landmark.is_point()) return true;
    return (ekf_.state().position(landmark.block) - ekf_.state().pose().position()).norm() < reach_m_;
  }

  /// The noise of a bearing, by itself or by the rig [rad^2].
  double variance_rad2(const Bearing& bearing) const;
  MappedSighting sighting_of(const PlanarLandmark& landmark, const Bearing& bearing) const;

  /// A landmark as it should be seen.
  struct Predicted {
    ObservationRow row;
    double azimuth_rad;    ///< in the camera's frame
    double variance_rad2;  ///< of that, what a linear prediction leaves out included
  };
  /// Nothing when it is too near. How far from the image's centre is known from the last time, near enough for the
  /// little the centre's error turns it.
  std::optional<Predicted> predict(const PlanarLandmark& landmark) const;

  /// h(x) for a bearing of the rig's own noise, straight through the image's centre, with H P H^T (SPEC I.6, I.7).
  std::optional<Predicted> predict_straight(const PlanarLandmark& landmark) const;

 private:
  const BearingEkf& ekf_;
  const CameraRig& camera_;
  double reach_m_;
};

}  // namespace azimuth
