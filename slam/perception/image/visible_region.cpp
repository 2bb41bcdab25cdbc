#include "slam/perception/image/visible_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/geometry/index.hpp"
#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {
namespace {

constexpr std::int32_t kNothing = -1;

/// For each pixel of a square, the nearest pixel of a set, found by Danielsson's method in two sweeps over the rows:
/// the member nearest to a pixel is also nearest to one of its neighbours, up to errors far below a pixel.
class NearestMap {
 public:
  NearestMap(int side, const std::vector<bool>& members) : side_(side), nearest_(members.size(), kNothing) {
    for (std::size_t i = 0; i < members.size(); ++i)
      if (members[i]) nearest_[i] = static_cast<std::int32_t>(i);
    for (int y = 0; y < side; ++y) sweep_row(y, -1);
    for (int y = side - 1; y >= 0; --y) sweep_row(y, 1);
  }

  /// Index of the nearest member; kNothing if the set is empty.
  std::int32_t at(int x, int y) const { return nearest_[index(x, y)]; }
  float distance(int x, int y) const {
    const std::int32_t member = at(x, y);
    return member == kNothing ? std::numeric_limits<float>::infinity() : distance(x, y, member);
  }

 private:
  std::size_t index(int x, int y) const { return as_size(y * side_ + x); }
  float distance(int x, int y, std::int32_t member) const {
    const std::int32_t column = member % side_, row = member / side_;
    return hypotenuse(static_cast<float>(x - column), static_cast<float>(y - row));
  }
  void take_from(int x, int y, int from_x, int from_y) {
    if (from_x < 0 || from_y < 0 || from_x >= side_ || from_y >= side_) return;
    const std::int32_t member = at(from_x, from_y);
    if (member != kNothing && distance(x, y, member) < distance(x, y)) nearest_[index(x, y)] = member;
  }
  void sweep_row(int y, int from) {
    for (int x = 0; x < side_; ++x)
      for (const int dx : {-1, 0, 1}) take_from(x, y, x + dx, y + from);
    for (int x = 0; x < side_; ++x) take_from(x, y, x - 1, y);
    for (int x = side_ - 1; x >= 0; --x) take_from(x, y, x + 1, y);
  }

  int side_;
  std::vector<std::int32_t> nearest_;
};

/// A pixel of the square mixes camera pixels up to its neighbours' centres, so it is visible only if its neighbours
/// are.
bool all_visible(const WorkingSquare& square, const ImageMask& mask, int width_px, int height_px, int x, int y) {
  const auto visible = [&](const Pixel& pixel) {
    return pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() <= width_px - 1 && pixel.y() <= height_px - 1 &&
           mask.visible(pixel);
  };
  for (const int dy : {-1, 0, 1})
    for (const int dx : {-1, 0, 1})
      if (!visible(square.camera_pixel(x + dx, y + dy))) return false;
  return true;
}

}  // namespace

VisibleRegion::VisibleRegion(const WorkingSquare& square, const MaskShape& shape, int width_px, int height_px)
    : side_px_(square.side_px) {
  const ImageMask mask(square.axes, shape);
  std::vector<bool> visible, hidden;
  for (int y = 0; y < side_px_; ++y)
    for (int x = 0; x < side_px_; ++x) visible.push_back(all_visible(square, mask, width_px, height_px, x, y));
  hidden = visible;
  hidden.flip();
  empty_ = std::ranges::find(visible, true) == visible.end();

  const NearestMap nearest_visible(side_px_, visible), nearest_hidden(side_px_, hidden);
  for (int y = 0; y < side_px_; ++y) {
    Span span{side_px_, 0};
    for (int x = 0; x < side_px_; ++x) {
      const int to_edge = std::min({x + 1, y + 1, side_px_ - x, side_px_ - y});
      clearance_px_.push_back(std::min(nearest_hidden.distance(x, y), static_cast<float>(to_edge)));
      if (visible[as_size(y * side_px_ + x)]) {
        span = {std::min(span.first, x), x + 1};
      } else if (nearest_visible.at(x, y) != kNothing) {
        add_copy(x, y, nearest_visible.at(x, y));
      }
    }
    spans_.push_back(span.first < span.last ? span : Span{});
  }
}

void VisibleRegion::add_copy(int x, int y, int from) {
  const auto narrow = [](int value) { return static_cast<std::uint16_t>(value); };
  copies_.push_back({narrow(x), narrow(y), narrow(from % side_px_), narrow(from / side_px_)});
}

float VisibleRegion::clearance_px(float x, float y) const {
  const int column = static_cast<int>(std::lround(x)), row = static_cast<int>(std::lround(y));
  if (column < 0 || row < 0 || column >= side_px_ || row >= side_px_) return 0.0F;
  return clearance_px_[as_size(row * side_px_ + column)];
}

void VisibleRegion::fill(Plane<std::uint16_t>& image) const {
  for (const Copy& copy : copies_) image.at(copy.to_x, copy.to_y) = image.at(copy.from_x, copy.from_y);
}

}  // namespace azimuth
