#pragma once
// The loops of scan.hpp, included once for each instruction set that they are compiled for. All names here have
// internal linkage, and no code calls the standard library, so the linker cannot merge code for different processors.

#include "slam/perception/colour/scan.hpp"

#ifndef AZIMUTH_BLOCK_BYTES
#define AZIMUTH_BLOCK_BYTES 16
#endif

namespace azimuth {
namespace {

using Byte = std::uint8_t;
// NOLINTBEGIN(misc-definitions-in-headers): a copy for each instruction set is the point
constexpr int kBlockBytes = AZIMUTH_BLOCK_BYTES;  // Bytes processed together: one register.
constexpr unsigned kTableBits = 6, kTableDropped = 2;
// NOLINTEND(misc-definitions-in-headers)
using Bytes = Byte __attribute__((vector_size(kBlockBytes)));
using Words = std::uint64_t __attribute__((vector_size(kBlockBytes)));

inline Bytes load(const Byte* from) {
  Bytes bytes;
  __builtin_memcpy(&bytes, from, sizeof bytes);
  return bytes;
}

inline Bytes distance(const Bytes& a, const Bytes& b) { return (a > b ? a : b) - (a > b ? b : a); }

inline bool any_reaches(const Bytes& values, Byte least) {
  const auto reached = reinterpret_cast<Words>(values >= least);
  std::uint64_t any = 0;
  for (int i = 0; i < kBlockBytes / 8; ++i) any |= reached[i];
  return any != 0;
}

inline std::size_t cell(unsigned first, unsigned second, unsigned third) {
  return (first >> kTableDropped) << (2 * kTableBits) | (second >> kTableDropped) << kTableBits |
         third >> kTableDropped;
}

/// rgb8 and bgr8. Red: the byte index of the red sample.
template <int Red>
struct ThreeBytes {
  static constexpr int kBlock = kBlockBytes / 3;  // Whole pixels in a block of bytes

  const Byte* row;
  int row_bytes;
  const Byte* classes;
  Byte least_chroma;

  ThreeBytes(const Scan& scan, int v)
      : row(scan.bytes + static_cast<std::ptrdiff_t>(v) * scan.format.stride_bytes),
        row_bytes(3 * scan.format.width_px),
        classes(scan.classes),
        least_chroma(scan.least_chroma) {}

  Byte class_at(int u) const {
    const Byte* const pixel = row + 3 * u;
    return classes[cell(pixel[Red], pixel[1], pixel[2 - Red])];
  }
  /// Compares each sample with the next and the one after. The three differences of every pixel are among these.
  /// Differences between neighbouring pixels occur too; they cost time but do not change the result.
  bool grey_block(int u) const {
    const Byte* const pixel = row + 3 * u;
    const Bytes here = load(pixel), next = load(pixel + 1), second_next = load(pixel + 2);
    const Bytes a = distance(here, next), b = distance(here, second_next);
    return !any_reaches(a > b ? a : b, least_chroma);
  }
  /// The first column from `u` on that may have a class.
  int past_grey(int u, int end) const {
    while (u < end && 3 * u + kBlockBytes + 2 <= row_bytes && grey_block(u)) u += kBlock;
    return u;
  }
};

/// yuyv and uyvy. Luma: the byte index of the first luma sample.
template <int Luma>
struct TwoBytes {
  static constexpr int kBlock = kBlockBytes / 2;

  const Byte* row;
  int row_bytes;
  const Byte* classes;
  Byte least_chroma;

  TwoBytes(const Scan& scan, int v)
      : row(scan.bytes + static_cast<std::ptrdiff_t>(v) * scan.format.stride_bytes),
        row_bytes(2 * scan.format.width_px),
        classes(scan.classes),
        least_chroma(scan.least_chroma) {}

  Byte class_at(int u) const {
    const Byte* const pair = row + 4 * (u / 2);
    return classes[cell(pair[Luma + 2 * (u % 2)], pair[1 - Luma], pair[3 - Luma])];
  }
  bool grey_block(int u) const {
    const Bytes luma_out = reinterpret_cast<Bytes>(Words{} + (Luma == 0 ? 0xFF00FF00FF00FF00U : 0x00FF00FF00FF00FFU));
    const Bytes neutral = Bytes{} + 128;
    return !any_reaches(distance(load(row + 2 * u), neutral) & luma_out, least_chroma);
  }
  int past_grey(int u, int end) const {
    int even = u - u % 2;  // A chroma pair covers two columns
    while (even < end && 2 * even + kBlockBytes <= row_bytes && grey_block(even)) even += kBlock;
    return even > u ? even : u;
  }
};

/// nv12: rows of luma, followed by one row of chroma for every two rows of luma; chroma has one byte (U or V) a column.
struct TwoPlanes {
  static constexpr int kBlock = kBlockBytes;

  const Byte *luma, *chroma;
  int width;
  const Byte* classes;
  Byte least_chroma;

  TwoPlanes(const Scan& scan, int v)
      : luma(scan.bytes + static_cast<std::ptrdiff_t>(v) * scan.format.stride_bytes),
        chroma(scan.bytes + static_cast<std::ptrdiff_t>(scan.format.height_px + v / 2) * scan.format.stride_bytes),
        width(scan.format.width_px),
        classes(scan.classes),
        least_chroma(scan.least_chroma) {}

  Byte class_at(int u) const {
    const Byte* const pair = chroma + 2 * (u / 2);
    return classes[cell(luma[u], pair[0], pair[1])];
  }
  bool grey_block(int u) const { return !any_reaches(distance(load(chroma + u), Bytes{} + 128), least_chroma); }
  int past_grey(int u, int end) const {
    int even = u - u % 2;  // A chroma pair covers two columns
    while (even < end && even + kBlockBytes <= width && grey_block(even)) even += kBlock;
    return even > u ? even : u;
  }
};

/// Bayer cells of 2 x 2 samples. RedRow, RedColumn: the position of the red sample in the cell.
template <int RedRow, int RedColumn>
struct BayerCells {
  static constexpr int kBlock = 1 << 15;  // One class a cell costs only a quarter, so no block is skipped

  const Byte *red_row, *blue_row;
  const Byte* classes;

  BayerCells(const Scan& scan, int v) : classes(scan.classes) {
    const Byte* const upper = scan.bytes + static_cast<std::ptrdiff_t>(2 * v) * scan.format.stride_bytes;
    const Byte* const lower = upper + scan.format.stride_bytes;
    red_row = RedRow == 0 ? upper : lower;
    blue_row = RedRow == 0 ? lower : upper;
  }
  Byte class_at(int u) const {
    const Byte *const with_red = red_row + 2 * u, *const with_blue = blue_row + 2 * u;
    const unsigned green = (with_red[1 - RedColumn] + with_blue[RedColumn] + 1U) / 2;
    return classes[cell(with_red[RedColumn], green, with_blue[1 - RedColumn])];
  }
  static int past_grey(int u, int) { return u; }
};

/// Writes runs as long as there is room, and counts them.
struct RunWriter {
  ColourRun* runs;
  std::size_t room;
  std::size_t count = 0;

  void add(int row, int begin, int end, Byte class_number) {
    if (count < room)
      runs[count] = {static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(begin),
                     static_cast<std::uint16_t>(end), class_number};
    ++count;
  }
};

template <class Pixels>
void scan_span(const Pixels& pixels, const VisibleSpan& span, RunWriter& writer) {
  Byte open = 0;
  int begin = 0, u = span.begin;
  const int end = span.end;
  while (u < end) {
    const int coloured = pixels.past_grey(u, end);
    if (coloured > u && open != 0) {
      writer.add(span.row, begin, u, open);
      open = 0;
    }
    u = coloured;
    const int stop = u + Pixels::kBlock < end ? u + Pixels::kBlock : end;
    for (; u < stop; ++u) {
      const Byte here = pixels.class_at(u);
      if (here == open) continue;
      if (open != 0) writer.add(span.row, begin, u, open);
      begin = u;
      open = here;
    }
  }
  if (open != 0) writer.add(span.row, begin, end, open);
}

template <class Pixels>
std::size_t scan_spans(const Scan& scan, const VisibleSpan* spans, std::size_t count, ColourRun* out,
                       std::size_t room) {
  RunWriter writer{out, room};
  for (std::size_t i = 0; i < count && writer.count <= room; ++i)
    scan_span(Pixels(scan, spans[i].row), spans[i], writer);
  return writer.count < room ? writer.count : room + (writer.count > room ? 1 : 0);
}

inline std::size_t scan_image(const Scan& scan, const VisibleSpan* spans, std::size_t count, ColourRun* out,
                              std::size_t room) {
  switch (scan.format.pixels) {
    case PixelFormat::rgb8:
      return scan_spans<ThreeBytes<0>>(scan, spans, count, out, room);
    case PixelFormat::bgr8:
      return scan_spans<ThreeBytes<2>>(scan, spans, count, out, room);
    case PixelFormat::yuyv:
      return scan_spans<TwoBytes<0>>(scan, spans, count, out, room);
    case PixelFormat::uyvy:
      return scan_spans<TwoBytes<1>>(scan, spans, count, out, room);
    case PixelFormat::nv12:
      return scan_spans<TwoPlanes>(scan, spans, count, out, room);
    case PixelFormat::bayer_rggb8:
      return scan_spans<BayerCells<0, 0>>(scan, spans, count, out, room);
    case PixelFormat::bayer_grbg8:
      return scan_spans<BayerCells<0, 1>>(scan, spans, count, out, room);
    case PixelFormat::bayer_gbrg8:
      return scan_spans<BayerCells<1, 0>>(scan, spans, count, out, room);
    case PixelFormat::bayer_bggr8:
      return scan_spans<BayerCells<1, 1>>(scan, spans, count, out, room);
    default:
      return 0;
  }
}

}  // namespace
}  // namespace azimuth
