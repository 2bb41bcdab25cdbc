#pragma once
#include <cstddef>

namespace azimuth {

/// How much a window on a running robot remembers and shows, whatever is sent.
struct ViewLimits {
  std::size_t trail_points = 100'000;     ///< of the estimate, and as many of the truth
  std::size_t trail_piece = 2'000;        ///< points in one event
  std::size_t landmarks = 5'000;          ///< shown; of more only the number is told
  std::size_t path_points = 20'000;       ///< of the path in hindsight; of more every so many
  std::size_t bearings = 2'000;           ///< of an image
  std::size_t pieces = 200;               ///< that a map or a path may come in
  std::size_t picture_bytes = 4'000'000;  ///< of a JPEG
  std::size_t text_bytes = 500;           ///< of a sentence or a name
  std::size_t journal_lines = 60;         ///< for who begins to look later
};

}  // namespace azimuth
