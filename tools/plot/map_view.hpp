#pragma once
// What part of a map is shown, and what that leaves out.

#include <cstddef>
#include <string>

#include "tools/plot/extent.hpp"
#include "tools/plot/map_picture.hpp"

namespace azimuth {

/// Truth and where the robot was, and what is near that. Neither odometry that drifted off, nor a lost robot, nor a
/// landmark that is hardly known makes the rest small.
Extent view_of(const MapPicture& picture);

/// Whether the place of a landmark means something in a view whose shorter side is `view_m` long.
bool is_well_known(const PlottedLandmark& landmark, double view_m);

/// What is not in a picture, though it was handed over.
struct LeftOut {
  std::size_t landmarks = 0, of_landmarks = 0;  ///< that lie outside of the frame
  std::size_t true_landmarks = 0;
  std::size_t estimates = 0, of_estimates = 0;
  std::size_t odometry = 0, of_odometry = 0;
  std::size_t smoothed = 0, of_smoothed = 0;
  std::size_t pose_ellipses = 0;  ///< larger than the view
};

LeftOut left_out(const MapPicture& picture, const Box& shown_m);

/// For a person; empty when everything is there.
std::string words(const LeftOut& left_out, const std::string& landmark_word);

}  // namespace azimuth
