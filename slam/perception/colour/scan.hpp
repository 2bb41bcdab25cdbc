#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "slam/perception/colour/colour_run.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

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

}  // namespace azimuth
