#pragma once
// The paper's hall for the lamp benchmarks: a grid of 9 x 4.5 m on the ceiling. The camera sees lamps within 70 degrees
// of the zenith.

#include <Eigen/Core>
#include <vector>

namespace azimuth::bench {

inline constexpr double kMaxZenith_rad = 1.2217;

/// `count` lamps in `rows` rows along the x axis, centred at the origin. The robot drives along the x axis; no lamp is
/// directly above it.
std::vector<Eigen::Vector2d> ceiling_lamps(int count, int rows);

/// Drives from the middle of the hall to one end, to the other end and back. Calls `drive(distance_m)` for each stride.
template <class Drive>
void drive_through_hall(int count, int rows, double stride_m, const Drive& drive);

/// Half of the hall's length [m]: the distance of the outermost columns from the middle plus half a column spacing.
double hall_reach_m(int count, int rows);

}  // namespace azimuth::bench

template <class Drive>
void azimuth::bench::drive_through_hall(int count, int rows, double stride_m, const Drive& drive) {
  const double reach_m = hall_reach_m(count, rows);
  for (double x = 0.0; x < reach_m; x += stride_m) drive(stride_m);
  for (double x = -reach_m; x < reach_m; x += stride_m) drive(-stride_m);
  for (double x = 0.0; x < reach_m; x += stride_m) drive(stride_m);
}
