#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tools/plot/clip.hpp"

namespace azimuth {

/// Finds room for labels beside their points: inside of a frame, on nothing that is taken, and where there is a choice
/// off what would be a pity to write on. In cells of a few pixels, so that maps of thousands of landmarks take no time.
///
/// Thread contract: thread-bound.
class LabelSpace {
 public:
  explicit LabelSpace(const Box& frame_px);

  /// No label may touch these.
  void take(const Box& box_px);
  void take(std::span<const Eigen::Vector2d> line_px);
  /// Labels rather go elsewhere.
  void avoid(std::span<const Eigen::Vector2d> line_px);

  /// Something that has a label, or might have: a label stands nearer to its own point than to any other of them.
  void add_point(const Eigen::Vector2d& at_px) { points_px_.push_back(at_px); }

  /// Takes room of `size_px` beside `at_px`, at one of the distances, the nearest first. Nothing: there is none.
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
