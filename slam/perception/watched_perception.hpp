#pragma once
#include <memory>
#include <utility>

#include "slam/perception/image/image_watch.hpp"
#include "slam/perception/perception.hpp"

namespace azimuth {

/// Wraps a front end so that it gets only usable images. If ImageWatch finds trouble in an image, the bearing set is
/// empty and names the trouble.
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to the largest image.
class WatchedPerception final : public Perception {
 public:
  WatchedPerception(std::unique_ptr<Perception> front_end, const ImageWatch& watch)
      : front_end_(std::move(front_end)), watch_(watch) {}

  void observe(const ImageView& image, BearingSet& out) override {
    const ImageTrouble trouble = watch_.judge(image);
    if (trouble == ImageTrouble::none) return front_end_->observe(image, out);
    out.clear();
    out.trouble = trouble;
  }

 private:
  std::unique_ptr<Perception> front_end_;
  ImageWatch watch_;
};

}  // namespace azimuth
