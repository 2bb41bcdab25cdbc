#pragma once
// The hall of the second paper for the benchmarks of lamps: a grid of 9 x 4.5 m on the ceiling, of which the camera
// sees what is within 70 degrees of the zenith.

#include <Eigen/Core>
#include <vector>

namespace azimuth::bench {

inline constexpr double kMaxZenith_rad = 1.2217;

/// `count` lamps in so many `rows` along the x axis, about the origin. None is straight above the axis, along which
/// the robot drives.
std::vector<Eigen::Vector2d> ceiling_lamps(int count, int rows);

/// From the middle of the hall to its end, to the other end and back to the middle: `drive(distance_m)` for each
/// stride.
template <class Drive>
void drive_through_hall(int count, int rows, double stride_m, const Drive& drive);

/// Of the lamps' outermost columns from the middle, and half a column more.
double hall_reach_m(int count, int rows);

}  // namespace azimuth::bench

template <class Drive>
void azimuth::bench::drive_through_hall(int count, int rows, double stride_m, const Drive& drive) {
  const double reach_m = hall_reach_m(count, rows);
  for (double x = 0.0; x < reach_m; x += stride_m) drive(stride_m);
  for (double x = -reach_m; x < reach_m; x += stride_m) drive(-stride_m);
  for (double x = 0.0; x < reach_m; x += stride_m) drive(stride_m);
}
