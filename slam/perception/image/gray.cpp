#include "slam/perception/image/gray.hpp"

#include <algorithm>
#include <cstring>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

/// Weights in 1/256 of the first, second and third byte of a pixel.
struct Weights {
  int first, second, third;
};
constexpr Weights kRgb{77, 150, 29}, kBgr{29, 150, 77};

void weigh(const std::uint8_t* from, int count, const Weights& weights, std::uint8_t* out) {
  for (int i = 0; i < count; ++i, from += 3) {
    const int sum = weights.first * from[0] + weights.second * from[1] + weights.third * from[2];
    out[i] = static_cast<std::uint8_t>((sum + 128) >> 8);
  }
}

void every_second(const std::uint8_t* from, int count, std::uint8_t* out) {
  for (int i = 0; i < count; ++i) out[i] = from[2 * i];
}

/// Mirrors an index outside the image at its edge, which keeps the Bayer colour. A single row or column is its own
/// neighbour.
int inside(int index, int size) {
  if (index < 0) return std::min(1, size - 1);
  return index < size ? index : std::max(0, size - 2);
}

struct ThreeRows {
  const std::uint8_t *above, *here, *below;

  int column(int u) const { return above[u] + 2 * here[u] + below[u]; }
};

void average_colours(const ImageView& image, int row, int first, int last, std::uint8_t* out) {
  const int width = image.format.width_px, height = image.format.height_px;
  const ThreeRows rows{image.row(inside(row - 1, height)), image.row(row), image.row(inside(row + 1, height))};
  int left = rows.column(inside(first - 1, width)), middle = rows.column(first);
  for (int u = first; u < last; ++u) {
    const int right = rows.column(inside(u + 1, width));
    *out++ = static_cast<std::uint8_t>((left + 2 * middle + right + 8) >> 4);
    left = middle;
    middle = right;
  }
}

}  // namespace

void gray_row(const ImageView& image, int row, int first, int last, std::uint8_t* out) {
  const std::uint8_t* from = image.row(row) + first * bytes_per_pixel(image.format.pixels);
  const int count = last - first;
  switch (image.format.pixels) {
    case PixelFormat::gray8:
    case PixelFormat::nv12:  // The luma of nv12 has a plane of its own
      std::memcpy(out, from, as_size(count));
      break;
    case PixelFormat::yuyv:
      every_second(from, count, out);
      break;
    case PixelFormat::uyvy:
      every_second(from + 1, count, out);
      break;
    case PixelFormat::rgb8:
      weigh(from, count, kRgb, out);
      break;
    case PixelFormat::bgr8:
      weigh(from, count, kBgr, out);
      break;
    case PixelFormat::mjpeg:
      break;
    default:
      average_colours(image, row, first, last, out);
  }
}

}  // namespace azimuth
