#pragma once
// A fast and predictable front end: the first bytes of an image encode its bearings.

#include <chrono>
#include <functional>
#include <utility>

#include "slam/perception/perception.hpp"

namespace azimuth::test {

/// Byte 0 is the number of bearings. Byte k is the azimuth of bearing k, in units of 0.01 rad, with 128 for azimuth 0.
class FakePerception final : public Perception {
 public:
  /// Called for each image, on the perception thread.
  using OnImage = std::function<void(const ImageView&)>;

  explicit FakePerception(OnImage on_image = {}) : on_image_(std::move(on_image)) {}

  void observe(const ImageView& image, BearingSet& out) override {
    if (on_image_) on_image_(image);
    out.clear();
    if (!image.readable()) {
      out.trouble = ImageTrouble::unreadable;
      return;
    }
    const std::uint8_t* const row = image.row(0);
    for (int k = 1; k <= row[0] && k < image.format.width_px; ++k)
      out.bearings.push_back({.azimuth_rad = 0.01 * (row[k] - 128), .identity = k});
  }

 private:
  OnImage on_image_;
};

}  // namespace azimuth::test
