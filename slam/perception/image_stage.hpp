#pragma once
#include <cassert>
#include <cstdint>
#include <memory>
#include <utility>

#include "slam/perception/perception.hpp"

namespace azimuth {

/// From the pixels of a frame to its bearing set, the same way for daemon and replay.
///
/// Thread contract: thread-bound. Allocates as the front end does.
class ImageStage {
 public:
  explicit ImageStage(std::unique_ptr<Perception> front_end) : front_end_(std::move(front_end)) { assert(front_end_); }

  /// Replaces what `out` holds by what the frame shows, with its stamp and sequence. `pixels` without bytes: a frame
  /// that cannot be used, which gives no bearings and says that it is unreadable.
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
