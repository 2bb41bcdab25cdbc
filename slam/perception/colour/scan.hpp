#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "slam/sample/image.hpp"

namespace azimuth {

/// Consecutive samples of one row that have the same class.
struct ColourRun {
  std::uint16_t row = 0;
  std::uint16_t begin = 0, end = 0;  ///< Columns; `end` is one past the last.
  std::uint8_t class_number = 0;     ///< From 1

  int length() const { return end - begin; }
  friend bool operator==(const ColourRun&, const ColourRun&) = default;
};

/// Consecutive samples of one row that show the world.
struct VisibleSpan {
  std::uint16_t row = 0;
  std::uint16_t begin = 0, end = 0;
};

/// An image and the colour table for it.
struct Scan {
  const std::uint8_t* bytes = nullptr;
  FrameFormat format;                     ///< Must be valid and have colour
  const std::uint8_t* classes = nullptr;  ///< ClassTable::data() for the format's samples
  std::uint8_t least_chroma = 0;          ///< ClassTable::least_chroma()
};

/// Whether the format has colour.
bool has_colour(PixelFormat pixels);

/// Side length in pixels of the sample that gets one class: 2 for Bayer formats, whose cells of 2 x 2 pixels give one
/// colour.
int pixels_per_sample(PixelFormat pixels);

/// Classifies the pixels in `spans` and writes the runs of equal class to `out`, in the order of `spans` (columns and
/// rows in samples, inside the image). Returns the number of runs, or out.size() + 1 if there is no room for all.
///
/// The runs are the same on every processor.
std::size_t find_runs(const Scan& scan, std::span<const VisibleSpan> spans, std::span<ColourRun> out);

// The AVX2 variant of find_runs(); only for processors with AVX2.
namespace avx2 {
std::size_t find_runs(const Scan& scan, const VisibleSpan* spans, std::size_t count, ColourRun* out, std::size_t room);
}

}  // namespace azimuth
