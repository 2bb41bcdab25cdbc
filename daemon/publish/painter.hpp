#pragma once
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "daemon/publish/expected_image.hpp"
#include "daemon/publish/lcm_sender.hpp"
#include "daemon/publish/publish_settings.hpp"
#include "drivers/camera/jpeg.hpp"
#include "drivers/picture/picture.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// An image and the bearings detected in it, on their way to the painter.
struct SeenImage {
  FrameFormat format{};
  std::vector<std::byte> bytes;
  BearingSet seen;
};

/// Draws pictures, and writes and publishes them as JPEG. When the file cannot be written, this is logged once per
/// change of the cause.
///
/// Thread contract: thread-bound; not for real-time threads.
class Painter {
 public:
  Painter(const PictureSettings& settings, const PublishSettings& publish, const CameraRig& rig);

  /// Shortest time between two pictures.
  std::chrono::nanoseconds interval() const;
  void paint(const SeenImage& image, const ExpectedImage& expected);
  std::uint64_t painted() const { return painted_; }

 private:
  void write(std::span<const std::byte> jpeg);
  void publish(Stamp stamp, const FrameFormat& format, std::span<const std::byte> jpeg);

  PictureSettings settings_;
  Picture picture_;
  JpegDecoder decoder_;
  JpegEncoder encoder_;
  LcmSender sender_;
  std::string trouble_;  // why the file could not be written
  std::uint64_t painted_ = 0;
};

}  // namespace azimuth
