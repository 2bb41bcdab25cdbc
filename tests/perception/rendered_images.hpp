#pragma once
// Images for the tests of perception: rendered by the simulator's cameras, with optional disturbances.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "sim/world/scenario.hpp"
#include "slam/camera/make_camera.hpp"
#include "slam/sample/image.hpp"
#include "tests/sim/renderer/views.hpp"

namespace azimuth::test {

struct Image {
  FrameFormat format;
  std::vector<std::byte> bytes;
  ImageView view() const { return {format, bytes}; }
};

inline constexpr std::array kUncompressed{PixelFormat::gray8,       PixelFormat::yuyv,        PixelFormat::uyvy,
                                          PixelFormat::rgb8,        PixelFormat::bgr8,        PixelFormat::bayer_rggb8,
                                          PixelFormat::bayer_grbg8, PixelFormat::bayer_gbrg8, PixelFormat::bayer_bggr8,
                                          PixelFormat::nv12};

inline Image blank(PixelFormat pixels, int width_px, int height_px) {
  const FrameFormat format = packed_format(pixels, width_px, height_px);
  return {format, std::vector<std::byte>(format.bytes())};
}

inline const RenderScene& lab_scene() {
  static const RenderScene scene = coloured_scene(lab(1, 1));
  return scene;
}

inline Image rendered(const RenderScene& scene, const RenderCamera& camera, const Pose2& T_world_body) {
  Image image = blank(PixelFormat::gray8, camera.width_px, camera.height_px);
  image.bytes = frame_of(scene, camera, T_world_body);
  return image;
}

/// The coloured lab through the mirror: centre (512, 384), visible ring from 60 to 376 px, black outside it.
inline const Image& mirror_image() {
  static const Image image = rendered(lab_scene(), mirror_camera(), {});
  return image;
}

/// Lamps seen through an infra-red filter.
inline Image lamps_image() { return rendered(lamp_scene(hall(1, 1), 6.5), fisheye_camera(), {}); }

/// A grey image converted to any uncompressed format.
inline Image in_format(const Image& gray, PixelFormat pixels) {
  Image out = blank(pixels, gray.format.width_px, gray.format.height_px);
  const auto size = static_cast<std::size_t>(bytes_per_pixel(pixels));
  std::ranges::fill(out.bytes, std::byte{128});  // the chroma plane, if the format has one
  for (std::size_t i = 0; i < gray.bytes.size(); ++i) {
    for (std::size_t k = 0; k < size; ++k) {
      const bool is_colour = (pixels == PixelFormat::yuyv && k == 1) || (pixels == PixelFormat::uyvy && k == 0);
      out.bytes[size * i + k] = is_colour ? std::byte{128} : gray.bytes[i];
    }
  }
  return out;
}

/// The image with `light` times the light, clipped at 255.
inline Image scaled(const Image& gray, double light) {
  Image out = gray;
  for (std::byte& byte : out.bytes) {
    byte = static_cast<std::byte>(std::min(255.0, light * std::to_integer<int>(byte)));
  }
  return out;
}

/// Combines two grey images: `inside` where the rig's mask is visible, `outside` everywhere else.
inline Image combined(const Image& inside, const Image& outside, const ImageRig& rig) {
  const std::vector<std::uint8_t> visible =
      ImageMask(axes_of(rig), mask_of(rig)).raster(inside.format.width_px, inside.format.height_px);
  Image out = outside;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    if (visible[i] != 0) out.bytes[i] = inside.bytes[i];
  }
  return out;
}

}  // namespace azimuth::test
