#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "slam/ekf/camera_errors.hpp"
#include "slam/estimator/estimator.hpp"

namespace azimuth {

/// How high landmarks are above the camera.
struct UsualHeight {
  double mean_m = 0.0;    ///< harmonic
  double spread_m = 0.0;  ///< from landmark to landmark, standard deviation
};

/// What a filter that begins anew was told by the one before it.
struct SecondBeginning {
  Eigen::Vector4d camera_errors;           ///< as CameraErrors::mean
  double sigma_centre_px = 0.0;            ///< standard deviation of the centre's, along each axis
  std::int64_t next_id = 0;                ///< of landmarks: none is used again
  std::optional<UsualHeight> height = {};  ///< what a new landmark is linearised about
};

/// A filter that can be begun anew from the same samples (second_start.hpp).
///
/// Thread contract: thread-bound.
class BeginsTwice : public Estimator {
 public:
  std::optional<CameraErrors> camera_errors() const override = 0;
  /// Landmarks were seen from places far enough apart for what is said of the centre to be worth anything: errors that
  /// images of one view share do not average out, however many images there are.
  virtual bool views_differ() const { return true; }
  /// Of landmarks above the camera; nothing: they are mapped in the plane, or there are none yet.
  virtual std::optional<UsualHeight> usual_height() const { return std::nullopt; }
  /// The robot may be anywhere on the map, which is kept as it is meanwhile.
  virtual bool searching() const = 0;
  virtual AssociationCounts counts() const = 0;
  /// Of the landmark that will be begun next; one more for each that was, and for each skipped.
  virtual std::int64_t next_id() const = 0;
  /// Of those before it, the ones that no landmark of this filter has had.
  virtual std::int64_t ids_skipped() const { return 0; }
};

}  // namespace azimuth
