#pragma once
// The interface every image front end has: colour (SPEC I.11), SIFT (I.12), lamps (II.1).

#include "slam/sample/bearings.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Finds in images what the estimator can use.
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to the largest image. Same images in the
/// same order, same bits.
class Perception {
 public:
  virtual ~Perception() = default;

  /// Replaces what `out` holds by what `image` shows, in the robot's frame; stamp and sequence are the caller's. An
  /// image that is of no use gives no bearings and says why (`out.trouble`). Any bytes are safe.
  virtual void observe(const ImageView& image, BearingSet& out) = 0;
};

}  // namespace azimuth
