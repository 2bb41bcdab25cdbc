#pragma once
#include <memory>
#include <utility>

#include "slam/perception/image/image_watch.hpp"
#include "slam/perception/perception.hpp"

namespace azimuth {

/// A front end that only sees images of use: those in which ImageWatch finds trouble give no bearings and say what it
/// is.
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
