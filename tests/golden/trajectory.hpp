#pragma once
// A trajectory as text that can be reviewed line by line: an estimator's output at some dozens of steps of a drive.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slam/estimator/estimate.hpp"

namespace azimuth::golden {

/// The quantities of a line, in the order of its columns.
inline constexpr std::array<std::string_view, 8> kQuantities{
    "t_s", "x_m", "y_m", "heading_rad", "sigma_x_m", "sigma_y_m", "sigma_heading_rad", "landmarks"};

/// The estimate at one step; steps are counted from 1.
struct Waypoint {
  std::size_t step = 0;
  std::array<double, kQuantities.size()> numbers{};
  std::string health;
};
using Trajectory = std::vector<Waypoint>;

Waypoint waypoint(std::size_t step, const Estimate& estimate);

/// Selects some dozens of steps: evenly spaced ones, the first, the last, and every step at which health changes.
Trajectory thinned(const Trajectory& every_step);

/// Writes a header and a line for each waypoint, with nine decimals.
std::string to_text(const Trajectory& trajectory);
/// Returns nullopt when `text` does not have the format of to_text().
std::optional<Trajectory> from_text(std::string_view text);

/// One sentence for each difference beyond kTolerance, with the step, the quantity, the expected and the actual value.
std::vector<std::string> differences(const Trajectory& expected, const Trajectory& got);
/// Wider than rounding differences: processors with fused multiply-add round differently from those without.
inline constexpr double kTolerance = 1e-6;

}  // namespace azimuth::golden
