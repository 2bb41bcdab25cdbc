#pragma once
#include <optional>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// Detects that bearings change while odometry stands still: the robot was lifted, or the encoders fail. The detection
/// needs neither a map nor a pose. Without identities, a landmark counts as moved when nothing was seen before in its
/// present direction.
///
/// Thread contract: thread-bound.
class RestWatch {
 public:
  explicit RestWatch(bool named) : named_(named) {}

  /// Adds a motion of the robot before the next add().
  void predict(const Motion& motion);
  /// Adds an image. `sigma_rad` is the standard deviation of bearings that carry none; `noise` is a factor on all
  /// standard deviations.
  void add(const BearingSet& image, double sigma_rad, double noise);
  /// Whether the robot is being carried. The state ends when the bearings stand still or odometry moves.
  bool is_carried() const { return carried_; }

 private:
  bool is_at_rest(Stamp stamp);
  /// The reference bearing that may be of the same landmark; null: none.
  const Bearing* seen_before(const Bearing& bearing) const;

  bool named_;
  double driven_m_ = 0.0, turned_rad_ = 0.0;  ///< since the robot came to rest
  std::optional<Stamp> rests_since_;
  /// The bearings of the first images at rest. Several images are used, since one of them may have missed landmarks.
  std::vector<Bearing> reference_;
  int images_ = 0;  ///< number of images in `reference_`
  Stamp seen_{};    ///< time of the last of these images
  bool carried_ = false;
};

}  // namespace azimuth
