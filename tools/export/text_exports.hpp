#pragma once
// Estimates as texts of other programs.

#include <optional>
#include <string>

#include "tools/export/estimated.hpp"
#include "tools/map_export/geojson_parts.hpp"

namespace azimuth {

/// A table with one line per pose: time, pose, covariance, calibrated odometry, health and its reason. Column names are
/// those of run folders, so that `azimuth import` reads the table. Numbers are written without loss. Unknown values are
/// empty. A reason that contains a comma is quoted.
std::string poses_csv(const Estimated& estimated);

/// A trajectory in the format of the KITTI odometry benchmark: one line per pose with the twelve numbers of [R | t],
/// row by row, without time. Axes are those of a camera that looks ahead at the robot's position: x to the right, y
/// down, z ahead. The map frame is rotated in the same way (its x axis becomes z, its y axis becomes -x), so that the
/// first line of a run without an initial map is the identity.
std::string kitti_text(const Estimated& estimated);

/// The times of the lines of kitti_text() in the format of the benchmark's times.txt: seconds since the first pose, one
/// per line.
std::string kitti_times(const Estimated& estimated);

/// The path as a line with the id "path" and a time for each position, and a point for each landmark with its
/// covariance and the axes of its one-sigma ellipse. Frames and ids are those of map_geojson(). A path across the
/// antimeridian is split there, as RFC 7946 requires.
std::string path_geojson(const Estimated& estimated, const std::optional<MapOrigin>& origin);

}  // namespace azimuth
