#include "tests/golden/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <set>
#include <sstream>

#include "slam/geometry/angle.hpp"

namespace azimuth::golden {
namespace {

constexpr std::size_t kLines = 40;
constexpr std::string_view kHeader =
    "step t_s x_m y_m heading_rad sigma_x_m sigma_y_m sigma_heading_rad landmarks health";

bool is_same(std::string_view quantity, double expected, double got) {
  const double off = quantity == "heading_rad" ? wrap(got - expected) : got - expected;
  return std::abs(off) <= kTolerance;
}

void compare(const Waypoint& expected, const Waypoint& got, std::vector<std::string>& out) {
  for (std::size_t i = 0; i < kQuantities.size(); ++i) {
    if (!is_same(kQuantities.at(i), expected.numbers.at(i), got.numbers.at(i)))
      out.push_back(fmt::format("step {}: {} expected {:.9f}, got {:.9f}", expected.step, kQuantities.at(i),
                                expected.numbers.at(i), got.numbers.at(i)));
  }
  if (expected.health != got.health)
    out.push_back(fmt::format("step {}: health expected {}, got {}", expected.step, expected.health, got.health));
}

}  // namespace

Waypoint waypoint(std::size_t step, const Estimate& estimate) {
  const Pose2& T = estimate.T_map_body;
  const Eigen::Vector3d sigma = estimate.pose_covariance.diagonal().cwiseSqrt();
  return {.step = step,
          .numbers = {to_seconds(estimate.stamp), T.x_m, T.y_m, T.heading_rad, sigma.x(), sigma.y(), sigma.z(),
                      static_cast<double>(estimate.landmarks.size())},
          .health = std::string(to_string(estimate.health))};
}

Trajectory thinned(const Trajectory& every_step) {
  const std::size_t all = every_step.size();
  std::set<std::size_t> kept;
  for (std::size_t line = 0; line < kLines && all > 0; ++line) kept.insert(line * (all - 1) / (kLines - 1));
  for (std::size_t i = 1; i < all; ++i)
    if (every_step[i].health != every_step[i - 1].health) kept.insert(i);
  Trajectory out;
  for (const std::size_t i : kept) out.push_back(every_step[i]);
  return out;
}

std::string to_text(const Trajectory& trajectory) {
  std::string text(kHeader);
  text += '\n';
  for (const Waypoint& waypoint : trajectory) {
    fmt::format_to(std::back_inserter(text), "{}", waypoint.step);
    for (std::size_t i = 0; i < kQuantities.size(); ++i)
      fmt::format_to(std::back_inserter(text), " {:.{}f}", waypoint.numbers.at(i),
                     kQuantities.at(i) == "landmarks" ? 0 : 9);
    fmt::format_to(std::back_inserter(text), " {}\n", waypoint.health);
  }
  return text;
}

std::optional<Trajectory> from_text(std::string_view text) {
  std::istringstream lines{std::string(text)};
  std::string line;
  if (!std::getline(lines, line) || line != kHeader) return std::nullopt;
  Trajectory trajectory;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    Waypoint& waypoint = trajectory.emplace_back();
    fields >> waypoint.step;
    for (double& number : waypoint.numbers) fields >> number;
    if (!(fields >> waypoint.health) || !(fields >> std::ws).eof()) return std::nullopt;
  }
  return trajectory;
}

std::vector<std::string> differences(const Trajectory& expected, const Trajectory& got) {
  std::vector<std::string> out;
  if (expected.size() != got.size())
    out.push_back(fmt::format("expected {} lines, got {}", expected.size(), got.size()));
  for (std::size_t i = 0; i < std::min(expected.size(), got.size()); ++i) {
    if (expected[i].step != got[i].step) {
      out.push_back(fmt::format("step {} expected, got step {}", expected[i].step, got[i].step));
      break;  // the steps differ, so all following lines belong to different instants
    }
    compare(expected[i], got[i], out);
  }
  return out;
}

}  // namespace azimuth::golden
