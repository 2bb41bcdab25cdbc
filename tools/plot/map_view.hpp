#pragma once
// Chooses the visible part of a map and counts the elements outside.

#include <cstddef>
#include <string>

#include "tools/plot/axes.hpp"
#include "tools/plot/map_picture.hpp"

namespace azimuth {

/// The visible part: the true or estimated path and its surroundings. Drifted odometry, paths of a lost robot and
/// inaccurate landmarks do not enlarge the view.
Extent view_of(const MapPicture& picture);

/// True if a landmark is accurate enough to be meaningful in a view whose shorter side has length `view_m`.
bool is_well_known(const PlottedLandmark& landmark, double view_m);

/// Numbers of elements of the picture that are not visible, out of how many.
struct LeftOut {
  std::size_t landmarks = 0, of_landmarks = 0;  ///< landmarks outside the frame
  std::size_t true_landmarks = 0;
  std::size_t estimates = 0, of_estimates = 0;
  std::size_t odometry = 0, of_odometry = 0;
  std::size_t smoothed = 0, of_smoothed = 0;
  std::size_t pose_ellipses = 0;  ///< larger than the view
};

LeftOut left_out(const MapPicture& picture, const Box& shown_m);

/// Text for the user; empty if everything is visible.
std::string words(const LeftOut& left_out, const std::string& landmark_word);

}  // namespace azimuth
