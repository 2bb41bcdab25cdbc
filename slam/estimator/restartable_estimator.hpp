#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "slam/ekf/camera_errors.hpp"
#include "slam/estimator/estimator.hpp"

namespace azimuth {

/// Height of landmarks above the camera.
struct UsualHeight {
  double mean_m = 0.0;    ///< Harmonic mean
  double spread_m = 0.0;  ///< Standard deviation of the height between landmarks
};

/// What the first filter found, as the starting point of the second filter (second_start.hpp).
struct Restart {
  Eigen::Vector4d camera_errors;           ///< Initial mean, laid out as CameraErrors::mean
  double sigma_centre_px = 0.0;            ///< Initial standard deviation of the image's centre, along each axis
  std::int64_t next_id = 0;                ///< Identifier of the first new landmark; no identifier is used twice
  std::optional<UsualHeight> height = {};  ///< Height about which a new landmark is linearised
};

/// A filter that can be restarted on the same samples (second_start.hpp).
///
/// Thread contract: thread-bound.
class RestartableEstimator : public Estimator {
 public:
  std::optional<CameraErrors> camera_errors() const override = 0;
  /// Whether landmarks were seen from places far enough apart for the centre's estimate to be trusted. Errors that all
  /// images of one view share do not average out, however many images there are.
  virtual bool views_differ() const { return true; }
  /// Height of the landmarks above the camera. Nothing when landmarks are mapped in the plane, or while there are none.
  virtual std::optional<UsualHeight> usual_height() const { return std::nullopt; }
  /// Whether the robot may be anywhere on the map. The map does not change while this holds.
  virtual bool searching() const = 0;
  virtual AssociationCounts counts() const = 0;
  /// Identifier of the next landmark to be initialised. It grows by one for each landmark initialised and for each
  /// identifier skipped.
  virtual std::int64_t next_id() const = 0;
  /// Number of identifiers before next_id() that no landmark of this filter has had.
  virtual std::int64_t ids_skipped() const { return 0; }
};

}  // namespace azimuth
