#pragma once
// Cameras of the images in the tests of SIFT.

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "drivers/camera/jpeg.hpp"
#include "slam/camera/camera_rig.hpp"
#include "tests/perception/rendered_images.hpp"
#include "tests/support/data.hpp"

namespace azimuth::test {

/// A camera of which only the centre and the ring are known.
inline CameraRig ring_rig(double u0, double v0, double inner_px, double outer_px) {
  CameraRig rig;
  rig.model = RadialRig{};
  rig.image.centre_px = {u0, v0};
  rig.image.mask_inner_px = inner_px;
  rig.image.mask_outer_px = outer_px;
  return rig;
}

/// The camera of mirror_camera() in views.hpp.
inline CameraRig lab_mirror_rig() {
  CameraRig rig = ring_rig(512.0, 384.0, 60.0, 376.0);
  rig.model = HyperbolicMirrorRig{.a_mm = 28.095, .b_mm = 23.4125, .focal_length_px = 1035.376};
  rig.image.azimuth_offset_rad = -kPi / 2;
  return rig;
}

struct RealImage {
  std::string file;  ///< in the data folder
  CameraRig rig;
  bool for_rotation = false;
};

/// All real mirror images, with rings measured by eye.
inline std::vector<RealImage> real_mirror_images() {
  std::vector<RealImage> images;
  const auto add = [&images](const std::string& name, int count, const CameraRig& rig) {
    for (int i = 1; i <= count; ++i) images.push_back({name + std::to_string(i) + ".jpg", rig, i == 1});
  };
  add("mirror-images/KaidanOmni", 8, ring_rig(332.0, 240.0, 70.0, 215.0));
  add("mirror-images/MiniOmni", 5, ring_rig(366.0, 240.0, 50.0, 215.0));
  add("mirror-calibration/imgMei_00", 5, ring_rig(642.92, 519.57, 60.0, 345.0));
  return images;
}

inline Image decoded(const RealImage& real) {
  std::ifstream file(data_folder() / real.file, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  JpegDecoder decoder;
  const ImageView view = decoder.decode(std::as_bytes(std::span(bytes)), PixelFormat::gray8);
  EXPECT_TRUE(view.readable()) << real.file << ": " << decoder.problem();
  return {view.format, {view.bytes.begin(), view.bytes.end()}};
}

}  // namespace azimuth::test
