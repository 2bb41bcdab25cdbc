// Frames of any format, size and content in every front end and in the debug picture. Detections must be finite, and no
// byte beyond the frame may be read.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <vector>

#include "drivers/camera/frame.hpp"
#include "drivers/camera/jpeg.hpp"
#include "drivers/picture/picture.hpp"
#include "slam/perception/make_perception.hpp"

namespace {

using namespace azimuth;

constexpr std::size_t kHeader = 5;
constexpr int kMaxJpegSide_px = 256;  // larger images only take time
constexpr std::array kFrontEnds{FrontEnd::colour, FrontEnd::sift, FrontEnd::lamps};

CameraRig rig() {
  CameraRig rig;
  rig.model = RadialRig{};
  rig.image.centre_px = PixelPoint{20.0, 16.0};
  rig.image.mask_outer_px = 200.0;
  return rig;
}

/// The lamp front end needs a camera model.
CameraRig fisheye() {
  CameraRig rig = ::rig();
  rig.model = EquidistantRig{.focal_length_px = 60.0};
  rig.image.theta_max_rad = 1.5;
  return rig;
}

Perception& perception(FrontEnd front_end) {
  static std::array<std::unique_ptr<Perception>, kFrontEnds.size()> all;
  auto& one = all[static_cast<std::size_t>(std::ranges::find(kFrontEnds, front_end) - kFrontEnds.begin())];
  if (!one) one = make_perception(front_end, front_end == FrontEnd::lamps ? fisheye() : rig(), {});
  return *one;
}

void look_at(const Frame& frame, FrontEnd front_end) {
  static BearingSet found;
  static JpegDecoder decoder;
  const bool is_jpeg = frame.format().pixels == PixelFormat::mjpeg;
  const ImageView image = is_jpeg ? decoder.decode(frame.bytes(), decoded_format(front_end)) : frame.view();
  found.clear();
  perception(front_end).observe(image, found);
  for (const Bearing& bearing : found.bearings)
    if (!std::isfinite(bearing.azimuth_rad)) std::abort();
  if (found.trouble == ImageTrouble::unreadable && !found.bearings.empty()) std::abort();
}

void show(const Frame& frame) {
  static Picture picture(rig());
  const ImageView drawn = picture.draw(frame.view(), {}, {});
  if (!drawn.bytes.empty() && !drawn.readable()) std::abort();
}

/// Whether the image would only cost time.
bool is_large_jpeg(const Frame& frame) {
  static JpegDecoder decoder;
  const auto header = decoder.read_header(frame.bytes());
  return header && (header->width_px > kMaxJpegSide_px || header->height_px > kMaxJpegSide_px);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size <= kHeader) return 0;
  FrameFormat format = packed_format(static_cast<PixelFormat>(data[0] % kPixelFormats), data[1], data[2]);
  if (format.pixels != PixelFormat::mjpeg) format.stride_bytes += static_cast<std::int8_t>(data[3]);
  const std::vector<std::byte> bytes(reinterpret_cast<const std::byte*>(data + kHeader),
                                     reinterpret_cast<const std::byte*>(data + size));
  const Frame frame(nullptr, 0, format, bytes);
  if (format.pixels == PixelFormat::mjpeg && is_large_jpeg(frame)) return 0;
  look_at(frame, kFrontEnds[data[4] % kFrontEnds.size()]);
  if (format.pixels != PixelFormat::mjpeg) show(frame);
  return 0;
}
