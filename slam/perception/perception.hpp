#pragma once
// The interface of every image front end: colour (mathematics I.11), SIFT (mathematics I.12) and lamps (mathematics
// II.1).

#include <cassert>
#include <cstdint>
#include <memory>
#include <utility>

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

/// Turns the pixels of a frame into a bearing set. The daemon and the replay tool both use this stage.
///
/// Thread contract: thread-bound. Memory allocation is that of the front end.
class ImageStage {
 public:
  explicit ImageStage(std::unique_ptr<Perception> front_end) : front_end_(std::move(front_end)) { assert(front_end_); }

  /// Replaces the content of `out` with the bearings that the frame shows, its stamp and its sequence number. A
  /// `pixels` without bytes denotes an unusable frame: `out` gets no bearings and the trouble `unreadable`.
  void observe(const ImageView& pixels, Stamp stamp, std::uint64_t sequence, BearingSet& out) {
    out.clear();
    if (pixels.bytes.empty()) {
      out.trouble = ImageTrouble::unreadable;
    } else {
      front_end_->observe(pixels, out);
    }
    out.stamp = stamp;
    out.sequence = sequence;
  }

 private:
  std::unique_ptr<Perception> front_end_;
};

}  // namespace azimuth
