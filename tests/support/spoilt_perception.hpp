#pragma once
// Disturbs images between the camera and the front end.

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "slam/perception/perception.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/image.hpp"

namespace azimuth::test {

/// Changes the pixels before the front end receives them. Rows are `format.stride_bytes` long; `image` counts from 0.
using Spoil = std::function<void(const FrameFormat& format, std::vector<std::byte>& pixels, int image)>;

/// A front end that receives disturbed images.
class SpoiltPerception final : public Perception {
 public:
  SpoiltPerception(std::unique_ptr<Perception> front_end, Spoil spoil)
      : front_end_(std::move(front_end)), spoil_(std::move(spoil)) {}

  void observe(const ImageView& image, BearingSet& out) override {
    pixels_.assign(image.bytes.begin(), image.bytes.end());
    spoil_(image.format, pixels_, images_++);
    front_end_->observe({image.format, pixels_}, out);
  }

 private:
  std::unique_ptr<Perception> front_end_;
  Spoil spoil_;
  std::vector<std::byte> pixels_;
  int images_ = 0;
};

}  // namespace azimuth::test
