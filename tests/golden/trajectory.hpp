#pragma once
// A trajectory as text that can be reviewed line by line: what an estimator said at some dozens of steps of a drive.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "slam/estimator/estimate.hpp"

namespace azimuth::golden {

/// The numbers of a line, in the order of its columns.
inline constexpr std::array<std::string_view, 8> kQuantities{
    "t_s", "x_m", "y_m", "heading_rad", "sigma_x_m", "sigma_y_m", "sigma_heading_rad", "landmarks"};

/// What an estimate said at one step, counted from 1.
struct Waypoint {
  std::size_t step = 0;
  std::array<double, kQuantities.size()> numbers{};
  std::string health;
};
using Trajectory = std::vector<Waypoint>;

Waypoint waypoint(std::size_t step, const Estimate& estimate);

/// Some dozens of it, evenly spread, the first and the last included, and every one at which health is another.
Trajectory thinned(const Trajectory& every_step);

/// A header and a line for each waypoint; nine decimals.
std::string to_text(const Trajectory& trajectory);
/// Nothing when `text` is not as to_text() writes it.
std::optional<Trajectory> from_text(std::string_view text);

/// What is not the same to kTolerance, a sentence each: step, quantity, what was expected, what it is.
std::vector<std::string> differences(const Trajectory& expected, const Trajectory& got);
/// Wider than what rounding does: processors with fused multiply-add round differently from those without.
inline constexpr double kTolerance = 1e-6;

}  // namespace azimuth::golden
