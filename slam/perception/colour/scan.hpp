#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "slam/perception/colour/colour_run.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// An image and how to tell its colours.
struct Scan {
  const std::uint8_t* bytes = nullptr;
  FrameFormat format;                     ///< valid, and with colour
  const std::uint8_t* classes = nullptr;  ///< ClassTable::data() for the format's samples
  std::uint8_t least_chroma = 0;          ///< ClassTable::least_chroma()
};

/// Whether the format has colour at all.
bool has_colour(PixelFormat pixels);

/// Pixels along a side of what gets one class: 2 for Bayer formats, whose cells of 2 x 2 hold one colour.
int pixels_per_sample(PixelFormat pixels);

/// The one pass over an image: pixels to classes to runs, written to `out` in the order of `spans` (columns and rows in
/// samples, within the image). Returns their number, or out.size() + 1 when there is no room for all.
///
/// The same runs on every kind of processor.
std::size_t find_runs(const Scan& scan, std::span<const VisibleSpan> spans, std::span<ColourRun> out);

}  // namespace azimuth
