#include "tools/plot/clip.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace azimuth {
namespace {

constexpr double kFarthest = 1e12;  // coordinates larger than this leave no meaningful differences

bool is_place(const Eigen::Vector2d& point) { return point.allFinite() && point.cwiseAbs().maxCoeff() < kFarthest; }

/// The parameters in [0, 1] at which the segment from `from` to `to` enters and leaves the box (Liang and Barsky).
std::optional<std::pair<double, double>> inside(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                                const Box& box) {
  double enters = 0.0, leaves = 1.0;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const double way = to[axis] - from[axis], to_low = box.low[axis] - from[axis],
                 to_high = box.high[axis] - from[axis];
    if (way == 0.0) {
      if (to_low > 0.0 || to_high < 0.0) return std::nullopt;
      continue;
    }
    enters = std::max(enters, std::min(to_low / way, to_high / way));
    leaves = std::min(leaves, std::max(to_low / way, to_high / way));
  }
  if (enters >= leaves) return std::nullopt;
  return std::pair(enters, leaves);
}

}  // namespace

std::vector<PlotLine> clipped(std::span<const Eigen::Vector2d> line, const Box& box) {
  std::vector<PlotLine> pieces;
  bool open = false;  // the last piece ends at the start of the next segment
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Eigen::Vector2d &from = line[i - 1], &to = line[i];
    const auto part = is_place(from) && is_place(to) ? inside(from, to, box) : std::nullopt;
    if (!part) {
      open = false;
      continue;
    }
    if (!open) pieces.push_back({from + part->first * (to - from)});
    pieces.back().push_back(part->second == 1.0 ? to : Eigen::Vector2d(from + part->second * (to - from)));
    open = part->second == 1.0;
  }
  return pieces;
}

PlotLine thinned(std::span<const Eigen::Vector2d> line, double step) {
  PlotLine kept;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_end = i == 0 || i + 1 == line.size();
    if (is_end || !((line[i] - kept.back()).norm() < step)) kept.push_back(line[i]);
  }
  return kept;
}

}  // namespace azimuth
