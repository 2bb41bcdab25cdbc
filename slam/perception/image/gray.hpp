#pragma once
#include <cstdint>

#include "slam/sample/image.hpp"

namespace azimuth {

/// Converts columns [first, last) of one row to grey. Red, green and blue have the weights of luma (BT.601). A Bayer
/// pixel gets the mean of its 3 x 3 neighbourhood with binomial weights, which gives (R + 2 G + B) / 4 at every
/// position in the Bayer cell.
///
/// The image must be readable(), and the columns and the row inside it. Writes last - first values.
///
/// Thread contract: reentrant. Nothing allocates.
void gray_row(const ImageView& image, int row, int first, int last, std::uint8_t* out);

}  // namespace azimuth
