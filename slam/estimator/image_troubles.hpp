#pragma once
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// Counts consecutive useless images. A frozen image does not count while the robot stands still.
///
/// Thread contract: thread-bound.
class ImageTroubles {
 public:
  /// Adds an image, taken after `path_m` of driving.
  void add(ImageTrouble trouble, double path_m) {
    const bool moved = path_m > last_image_m_;
    last_image_m_ = path_m;
    last_ = trouble;
    if (trouble == ImageTrouble::none)
      in_row_ = 0;
    else if (trouble != ImageTrouble::frozen || moved)
      ++in_row_;
  }
  int in_row() const { return in_row_; }
  ImageTrouble last() const { return last_; }

 private:
  int in_row_ = 0;
  ImageTrouble last_ = ImageTrouble::none;
  double last_image_m_ = 0.0;
};

}  // namespace azimuth
