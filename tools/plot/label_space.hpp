#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tools/plot/clip.hpp"

namespace azimuth {

/// Places labels beside their points: inside a frame, not on occupied space, and preferably not on space to avoid. The
/// class uses a grid with cells of a few pixels, so that thousands of landmarks are placed quickly.
///
/// Thread contract: thread-bound.
class LabelSpace {
 public:
  explicit LabelSpace(const Box& frame_px);

  /// Marks space as occupied: no label may touch it.
  void take(const Box& box_px);
  void take(std::span<const Eigen::Vector2d> line_px);
  /// Marks space that labels avoid if possible.
  void avoid(std::span<const Eigen::Vector2d> line_px);

  /// Adds a point that has or could have a label. Each label is nearer to its own point than to any other one.
  void add_point(const Eigen::Vector2d& at_px) { points_px_.push_back(at_px); }

  /// Occupies space of `size_px` beside `at_px`. The distances are tried in order. Nothing if there is no space.
  std::optional<Box> place(const Eigen::Vector2d& at_px, const Eigen::Vector2d& size_px,
                           std::span<const double> distances_px);

 private:
  using Cell = Eigen::Array2i;
  enum class Use : std::uint8_t { free, avoided, taken };

  Cell cell(const Eigen::Vector2d& at_px) const;
  bool is_inside(const Cell& cell) const { return (cell >= 0).all() && (cell < cells_).all(); }
  Use& use(const Cell& cell) { return uses_[static_cast<std::size_t>(cell.y() * cells_.x() + cell.x())]; }
  void mark(std::span<const Eigen::Vector2d> line_px, Use as);
  int cost(const Box& box_px);
  bool is_clear(const Box& box_px, const Eigen::Vector2d& own_px) const;

  Box frame_px_;
  Cell cells_;
  std::vector<Use> uses_;
  std::vector<Eigen::Vector2d> points_px_;
};

}  // namespace azimuth
