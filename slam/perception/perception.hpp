#pragma once
// The interface of every image front end: colour (mathematics I.11), SIFT (mathematics I.12) and lamps (mathematics
// II.1).

#include "slam/sample/bearings.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Finds bearings in images.
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to the largest image. The same images in the
/// same order give the same bits.
class Perception {
 public:
  virtual ~Perception() = default;

  /// Replaces the content of `out` with the bearings that `image` shows, in the robot's frame. The caller sets the
  /// stamp and the sequence number. An unusable image gives no bearings, and `out.trouble` names the reason. Any bytes
  /// are safe.
  virtual void observe(const ImageView& image, BearingSet& out) = 0;
};

}  // namespace azimuth
