#pragma once
// A front end that is quick and predictable: the first bytes of an image say what is seen in it.

#include <chrono>
#include <functional>
#include <utility>

#include "slam/perception/perception.hpp"

namespace azimuth::test {

/// Byte 0 counts the bearings, byte k is the azimuth of the k-th in hundredths of a radian from -1.28.
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
