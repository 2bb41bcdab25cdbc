#include "tools/plot/label_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace azimuth {
namespace {

constexpr double kCell_px = 4.0;
constexpr int kTaken = -1;

/// Directions from a point to its label, in order of preference. A label to the right comes first.
const std::array<Eigen::Vector2d, 8> kDirections{
    {{1.0, 0.0}, {0.7, -0.7}, {0.7, 0.7}, {-1.0, 0.0}, {-0.7, -0.7}, {-0.7, 0.7}, {0.0, -1.0}, {0.0, 1.0}}};

/// The box of the label, whose nearest border or corner is `distance_px` away from the point.
Box beside(const Eigen::Vector2d& at_px, const Eigen::Vector2d& direction, double distance_px,
           const Eigen::Vector2d& size_px) {
  const Eigen::Vector2d half = size_px / 2;
  const Eigen::Vector2d middle = at_px + distance_px * direction + direction.cwiseSign().cwiseProduct(half);
  return {middle - half, middle + half};
}

}  // namespace

LabelSpace::LabelSpace(const Box& frame_px)
    : frame_px_(frame_px),
      cells_(((frame_px.high - frame_px.low) / kCell_px).array().ceil().max(1.0).cast<int>()),
      uses_(static_cast<std::size_t>(cells_.x()) * static_cast<std::size_t>(cells_.y()), Use::free) {}

LabelSpace::Cell LabelSpace::cell(const Eigen::Vector2d& at_px) const {
  return ((at_px - frame_px_.low) / kCell_px).array().floor().max(-1.0).min(1e6).cast<int>();
}

void LabelSpace::take(const Box& box_px) {
  const Cell low = cell(box_px.low).max(0), high = cell(box_px.high).min(cells_ - 1);
  for (Cell at = low; at.y() <= high.y(); ++at.y())
    for (at.x() = low.x(); at.x() <= high.x(); ++at.x()) use(at) = Use::taken;
}

void LabelSpace::take(std::span<const Eigen::Vector2d> line_px) { mark(line_px, Use::taken); }
void LabelSpace::avoid(std::span<const Eigen::Vector2d> line_px) { mark(line_px, Use::avoided); }

void LabelSpace::mark(std::span<const Eigen::Vector2d> line_px, Use as) {
  for (const PlotLine& piece : clipped(line_px, frame_px_))
    for (std::size_t i = 1; i < piece.size(); ++i) {
      const Eigen::Vector2d way = piece[i] - piece[i - 1];
      const int steps = 1 + static_cast<int>(way.norm() / (kCell_px / 2));
      for (int k = 0; k <= steps; ++k) {
        const Cell at = cell(piece[i - 1] + way * k / steps).min(cells_ - 1);
        if (is_inside(at) && use(at) < as) use(at) = as;
      }
    }
}

/// Number of covered cells to avoid; kTaken if the box is outside the frame or on occupied space.
int LabelSpace::cost(const Box& box_px) {
  if (!frame_px_.contains(box_px.low) || !frame_px_.contains(box_px.high)) return kTaken;
  const Cell low = cell(box_px.low), high = cell(box_px.high).min(cells_ - 1);
  int avoided = 0;
  for (Cell at = low; at.y() <= high.y(); ++at.y())
    for (at.x() = low.x(); at.x() <= high.x(); ++at.x()) {
      if (use(at) == Use::taken) return kTaken;
      if (use(at) == Use::avoided) ++avoided;
    }
  return avoided;
}

/// True if no other point is nearer to the box than its own point.
bool LabelSpace::is_clear(const Box& box_px, const Eigen::Vector2d& own_px) const {
  const auto distance_px = [&](const Eigen::Vector2d& point_px) {
    return (point_px - point_px.cwiseMax(box_px.low).cwiseMin(box_px.high)).norm();
  };
  return std::ranges::none_of(points_px_, [&, own_distance_px = distance_px(own_px)](const Eigen::Vector2d& other_px) {
    return other_px != own_px && distance_px(other_px) < own_distance_px;
  });
}

std::optional<Box> LabelSpace::place(const Eigen::Vector2d& at_px, const Eigen::Vector2d& size_px,
                                     std::span<const double> distances_px) {
  std::optional<Box> best;
  int least = 0;
  for (const double distance_px : distances_px)
    for (const Eigen::Vector2d& direction : kDirections) {
      const Box box = beside(at_px, direction, distance_px, size_px);
      const int price = cost(box);
      if (price == kTaken || (best && price >= least) || !is_clear(box, at_px)) continue;
      best = box;
      least = price;
    }
  if (best) take(*best);
  return best;
}

}  // namespace azimuth
