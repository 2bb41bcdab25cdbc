#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "slam/geometry/motion.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The identities in the newest images. A robot that drives through a door loses sight of one landmark after the other,
/// while other landmarks are where they should be; a robot that is carried off loses sight of all at once.
///
/// Thread contract: thread-bound.
class NamesSeen {
 public:
  /// Adds an image that fits the pose, at the driven distance `path_m`.
  void add(const BearingSet& image, double path_m);
  /// Skips a doubtful image. It is compared with the images before, but only a few such images are: an object that
  /// hides a landmark in one image hides it in the next, so further images add no information.
  void pass_over() { ++passed_over_; }

  /// Whether the landmark was seen a moment ago, so that the next image should show it.
  bool is_due(Identity name, double path_m) const;

 private:
  static constexpr std::size_t kImages = 3;
  struct Image {
    std::vector<Identity> names;
    double path_m = 0.0;
  };
  std::array<Image, kImages> images_;
  std::size_t next_ = 0, passed_over_ = 0;
};

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
