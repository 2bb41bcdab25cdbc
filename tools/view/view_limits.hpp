#pragma once
#include <cstddef>

namespace azimuth {

/// Limits of the data that a live view stores and shows, for any input.
struct ViewLimits {
  std::size_t trail_points = 100'000;     ///< points of the estimate's trail, and of the truth's trail
  std::size_t trail_piece = 2'000;        ///< points in one event
  std::size_t landmarks = 5'000;          ///< shown landmarks; of further ones only the number is sent
  std::size_t path_points = 20'000;       ///< points of the smoothed path; longer paths are thinned
  std::size_t bearings = 2'000;           ///< bearings of an image
  std::size_t pieces = 200;               ///< pieces of a map or path message
  std::size_t picture_bytes = 4'000'000;  ///< size of a JPEG image
  std::size_t text_bytes = 500;           ///< length of a sentence or name
  std::size_t journal_lines = 60;         ///< journal lines stored for clients that connect later
};

}  // namespace azimuth
