#pragma once
// Coloured images in all camera formats, converted from an image of full-colour pixels.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "slam/perception/colour/class_table.hpp"
#include "slam/sample/image.hpp"

namespace azimuth::test {

inline constexpr std::array kColourFormats{PixelFormat::rgb8,        PixelFormat::bgr8,        PixelFormat::yuyv,
                                           PixelFormat::uyvy,        PixelFormat::bayer_rggb8, PixelFormat::bayer_grbg8,
                                           PixelFormat::bayer_gbrg8, PixelFormat::bayer_bggr8, PixelFormat::nv12};

inline constexpr Rgb kRed{215, 25, 30}, kYellow{235, 205, 20}, kGreen{20, 165, 45}, kBlue{25, 50, 200};
inline constexpr Rgb kGrey{128, 128, 128};

struct Frame {
  FrameFormat format;
  std::vector<std::byte> bytes;

  ImageView view() const { return {format, bytes}; }
  std::byte* row(int v) {
    return bytes.data() + static_cast<std::size_t>(v) * static_cast<std::size_t>(format.stride_bytes);
  }
};

inline Frame frame_with_stride(PixelFormat pixels, int width_px, int height_px, int padding) {
  FrameFormat format = packed_format(pixels, width_px, height_px);
  format.stride_bytes += padding;
  return {format, std::vector<std::byte>(format.bytes())};
}

/// An image to paint on.
struct Canvas {
  int width_px = 0, height_px = 0;
  std::vector<Rgb> pixels;

  Canvas(int width, int height, Rgb colour = kGrey)
      : width_px(width),
        height_px(height),
        pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), colour) {}
  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(u);
  }
  Rgb& at(int u, int v) { return pixels[index(u, v)]; }
  const Rgb& at(int u, int v) const { return pixels[index(u, v)]; }
};

namespace detail {

inline std::byte byte_of(double value) { return static_cast<std::byte>(std::lround(std::clamp(value, 0.0, 255.0))); }

inline std::byte luma(Rgb c) { return byte_of(0.299 * c.red + 0.587 * c.green + 0.114 * c.blue); }

/// Writes two pixels as Y U Y V or U Y V Y, in full-range BT.601.
inline void write_pair(const Canvas& canvas, int u, int v, int luma_at, std::byte* pair) {
  const Rgb a = canvas.at(u, v), b = canvas.at(u + 1, v);
  const double red = 0.5 * (a.red + b.red), green = 0.5 * (a.green + b.green), blue = 0.5 * (a.blue + b.blue);
  pair[luma_at] = luma(a);
  pair[luma_at + 2] = luma(b);
  pair[1 - luma_at] = byte_of(128.0 - 0.168736 * red - 0.331264 * green + 0.5 * blue);
  pair[3 - luma_at] = byte_of(128.0 + 0.5 * red - 0.418688 * green - 0.081312 * blue);
}

/// Writes the common chroma of four pixels to the chroma plane below the luma rows.
inline void write_square(const Canvas& canvas, int u, int v, std::byte* pair) {
  double red = 0.0, green = 0.0, blue = 0.0;
  for (const auto& [du, dv] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
    const Rgb pixel = canvas.at(u + du, v + dv);
    red += 0.25 * pixel.red;
    green += 0.25 * pixel.green;
    blue += 0.25 * pixel.blue;
  }
  pair[0] = byte_of(128.0 - 0.168736 * red - 0.331264 * green + 0.5 * blue);
  pair[1] = byte_of(128.0 + 0.5 * red - 0.418688 * green - 0.081312 * blue);
}

/// The sample of a Bayer sensor at (u, v).
inline std::byte mosaic(const Canvas& canvas, int u, int v, int red_row, int red_column) {
  const Rgb colour = canvas.at(u, v);
  const bool on_red_row = v % 2 == red_row, on_red_column = u % 2 == red_column;
  if (on_red_row && on_red_column) return std::byte{colour.red};
  return std::byte{on_red_row || on_red_column ? colour.green : colour.blue};
}

inline void write_three(Rgb colour, std::byte* out, int red_at) {
  out[red_at] = std::byte{colour.red};
  out[1] = std::byte{colour.green};
  out[2 - red_at] = std::byte{colour.blue};
}

inline void write_pixel(const Canvas& canvas, int u, int v, PixelFormat pixels, std::byte* row) {
  switch (pixels) {
    case PixelFormat::rgb8:
    case PixelFormat::bgr8:
      return write_three(canvas.at(u, v), row + 3 * u, pixels == PixelFormat::rgb8 ? 0 : 2);
    case PixelFormat::yuyv:
    case PixelFormat::uyvy:
      if (u % 2 == 0) write_pair(canvas, u, v, pixels == PixelFormat::yuyv ? 0 : 1, row + 2 * u);
      return;
    case PixelFormat::bayer_rggb8:
      row[u] = mosaic(canvas, u, v, 0, 0);
      return;
    case PixelFormat::bayer_grbg8:
      row[u] = mosaic(canvas, u, v, 0, 1);
      return;
    case PixelFormat::bayer_gbrg8:
      row[u] = mosaic(canvas, u, v, 1, 0);
      return;
    case PixelFormat::bayer_bggr8:
      row[u] = mosaic(canvas, u, v, 1, 1);
      return;
    default:
      row[u] = luma(canvas.at(u, v));
  }
}

}  // namespace detail

/// The canvas as a camera with this format sends it.
inline Frame taken(const Canvas& canvas, PixelFormat pixels, int padding = 0) {
  Frame frame = frame_with_stride(pixels, canvas.width_px, canvas.height_px, padding);
  for (int v = 0; v < canvas.height_px; ++v)
    for (int u = 0; u < canvas.width_px; ++u) detail::write_pixel(canvas, u, v, pixels, frame.row(v));
  if (pixels != PixelFormat::nv12) return frame;
  for (int v = 0; v < canvas.height_px; v += 2)
    for (int u = 0; u < canvas.width_px; u += 2)
      detail::write_square(canvas, u, v, frame.row(canvas.height_px + v / 2) + u);
  return frame;
}

inline Rgb mixed(Rgb before, Rgb after, double part) {
  const auto mix = [part](int a, int b) { return static_cast<std::uint8_t>(std::lround(a + part * (b - a))); };
  return {mix(before.red, after.red), mix(before.green, after.green), mix(before.blue, after.blue)};
}

/// The shape of an upright object in the image: between two lines through the image centre.
struct Wedge {
  double centre_u_px = 0.0, centre_v_px = 0.0;
  double angle_rad = 0.0;  ///< from u towards v
  double half_width_rad = 0.06;
  double near_px = 150.0, far_px = 260.0;  ///< radii
};

/// Paints the wedge with an outline smoothed over about a pixel, as through a lens.
inline void paint(Canvas& canvas, const Wedge& wedge, Rgb colour) {
  for (int v = 0; v < canvas.height_px; ++v)
    for (int u = 0; u < canvas.width_px; ++u) {
      const double x = u - wedge.centre_u_px, y = v - wedge.centre_v_px, radius_px = std::hypot(x, y);
      const double off_rad = std::abs(wrap(std::atan2(y, x) - wedge.angle_rad));
      const double inside_px =
          std::min({(wedge.half_width_rad - off_rad) * radius_px, radius_px - wedge.near_px, wedge.far_px - radius_px});
      canvas.at(u, v) = mixed(canvas.at(u, v), colour, std::clamp(inside_px + 0.5, 0.0, 1.0));
    }
}

/// Adds independent sensor noise to each sample.
inline void add_noise(Canvas& canvas, double sigma, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, sigma);
  const auto noisy = [&](int value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value + noise(random), 0.0, 255.0)));
  };
  for (Rgb& pixel : canvas.pixels) pixel = {noisy(pixel.red), noisy(pixel.green), noisy(pixel.blue)};
}

}  // namespace azimuth::test
