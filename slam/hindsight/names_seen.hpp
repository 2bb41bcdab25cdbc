#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "slam/sample/bearings.hpp"

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

}  // namespace azimuth
