#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "slam/sample/map_snapshot.hpp"
#include "tools/plot/map_picture.hpp"

namespace azimuth {

/// Largest number of landmarks on a page. If there are more, the most accurate ones are shown.
inline constexpr std::size_t kMostPageLandmarks = 5000;

/// The final map, the true landmarks and the thinned smoothed path, as in the picture of --plot: in the map frame, in
/// metres, covariances in square metres.
nlohmann::ordered_json page_map(const MapPicture& picture);

/// The value rounded to a multiple of `unit`, or to five significant digits if `unit` is 0; null if it is not finite.
nlohmann::ordered_json page_number(double value, double unit = 0.0);

/// A saved map in the same form as page_run(), with empty columns since there is no drive.
nlohmann::ordered_json page_of_map(const MapSnapshot& map, const std::string& name);

}  // namespace azimuth
