#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The names that the newest images showed. Who goes through a door loses sight of one thing after the other, while
/// there are others where they should be; who is carried off, of all at once.
///
/// Thread contract: thread-bound.
class NamesSeen {
 public:
  /// An image that fits the pose, after `path_m` of driving.
  void add(const BearingSet& image, double path_m);
  /// One about which there is doubt: what the images before it showed is what it is compared with, but not for long.
  /// What hides a landmark in one image hides it in the next, so that further ones say nothing new.
  void pass_over() { ++passed_over_; }

  /// Seen a moment ago, so that the next image should show it.
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
