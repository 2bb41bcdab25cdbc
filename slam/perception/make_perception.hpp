#pragma once
#include <memory>
#include <utility>

#include "slam/camera/camera_rig.hpp"
#include "slam/perception/colour/colour_settings.hpp"
#include "slam/perception/image/image_watch.hpp"
#include "slam/perception/lamps/lamp_settings.hpp"
#include "slam/perception/perception.hpp"
#include "slam/perception/sift/sift_settings.hpp"

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

/// The settings of all image front ends; a run uses one of them.
struct PerceptionSettings {
  ColourSettings colour;
  SiftSettings sift;
  LampSettings lamps;
};

/// Makes the front end that finds bearings in the images of the rig's camera. The front end skips images in which
/// ImageWatch finds trouble. Returns null for FrontEnd::bearings, whose bearings need no image processing.
std::unique_ptr<Perception> make_perception(FrontEnd front_end, const CameraRig& rig,
                                            const PerceptionSettings& settings);

/// The pixel format to which compressed images must be decoded for a front end: gray8 if the front end uses only
/// brightness, else rgb8.
PixelFormat decoded_format(FrontEnd front_end);

}  // namespace azimuth
