#pragma once
#include <nlohmann/json.hpp>

#include "tools/plot/map_picture.hpp"

namespace azimuth {

/// Landmarks of a page at most; of more those that are known best.
inline constexpr std::size_t kMostPageLandmarks = 5000;

/// The map at the end, true landmarks, and the path in hindsight (thinned), as the picture of --plot has them: in the
/// map frame, metres, covariances in square metres.
nlohmann::ordered_json page_map(const MapPicture& picture);

/// Rounded to a multiple of `unit`, or to five significant digits where that is 0; null of what is no number.
nlohmann::ordered_json page_number(double value, double unit = 0.0);

}  // namespace azimuth
