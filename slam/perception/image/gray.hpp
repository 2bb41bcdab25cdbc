#pragma once
#include <cstdint>

#include "slam/sample/image.hpp"

namespace azimuth {

/// Columns `first` to `last` (not included) of one row in grey. Red, green and blue are weighted as luma is (BT.601); a
/// Bayer pixel takes the mean of its 3 x 3 surroundings with binomial weights, which holds as much of each colour
/// wherever it is: (R + 2 G + B) / 4.
///
/// Only readable() images and columns and rows inside them. Writes last - first values.
///
/// Thread contract: reentrant. Nothing allocates.
void gray_row(const ImageView& image, int row, int first, int last, std::uint8_t* out);

}  // namespace azimuth
