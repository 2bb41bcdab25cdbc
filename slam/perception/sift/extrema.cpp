#include "slam/perception/sift/extrema.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/geometry/index.hpp"
#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

// The greatest sample may be lower than the extremum of the function fitted to the samples, by this factor.
constexpr double kSampledShare = 0.8;
constexpr int kMostMoves = 5;
constexpr float kFinestScale = 1.0F;  // In scales of the first octave: finer extrema are found by chance only.
constexpr float kFarthest = 1.0F;     // Distance from the nearest sample, in steps between samples

/// A sample of the difference of Gaussians and its neighbours; the axes are x, y and scale.
class Samples {
 public:
  Samples(const ScaleSpace& space, int octave, int layer, int x, int y)
      : below_(space.difference(octave, layer - 1)),
        here_(space.difference(octave, layer)),
        above_(space.difference(octave, layer + 1)),
        x_(x),
        y_(y) {}

  float middle() const { return at(here_, 0, 0); }
  Vector3f gradient() const {
    return 0.5F * Vector3f(at(here_, 1, 0) - at(here_, -1, 0), at(here_, 0, 1) - at(here_, 0, -1),
                           at(above_, 0, 0) - at(below_, 0, 0));
  }
  Matrix3f hessian() const {
    const float xx = at(here_, 1, 0) + at(here_, -1, 0) - 2.0F * middle();
    const float yy = at(here_, 0, 1) + at(here_, 0, -1) - 2.0F * middle();
    const float ss = at(above_, 0, 0) + at(below_, 0, 0) - 2.0F * middle();
    const float xy = 0.25F * (at(here_, 1, 1) - at(here_, -1, 1) - at(here_, 1, -1) + at(here_, -1, -1));
    const float xs = 0.25F * (at(above_, 1, 0) - at(above_, -1, 0) - at(below_, 1, 0) + at(below_, -1, 0));
    const float ys = 0.25F * (at(above_, 0, 1) - at(above_, 0, -1) - at(below_, 0, 1) + at(below_, 0, -1));
    return Matrix3f{{xx, xy, xs}, {xy, yy, ys}, {xs, ys, ss}};
  }

 private:
  float at(const Plane<float>& plane, int right, int down) const { return plane.at(x_ + right, y_ + down); }

  const Plane<float>&below_, &here_, &above_;
  int x_, y_;
};

/// The extremum of the quadratic through the samples.
struct Fit {
  int x = 0, y = 0, layer = 0;         ///< The nearest sample
  Vector3f offset = Vector3f::Zero();  ///< Of the extremum from this sample
  float value = 0.0F;
  Matrix3f hessian = Matrix3f::Zero();
};

/// Moves the fit to the sample nearest to the computed extremum, within this octave.
void move(const ScaleSpace& space, int octave, Fit& fit) {
  const Plane<float>& plane = space.difference(octave, 0);
  const auto moved = [](int from, float offset, int last) {
    return std::clamp(from + static_cast<int>(std::lround(std::clamp(offset, -2.0F, 2.0F))), 1, last);
  };
  fit.x = moved(fit.x, fit.offset.x(), plane.width() - 2);
  fit.y = moved(fit.y, fit.offset.y(), plane.height() - 2);
  fit.layer = moved(fit.layer, fit.offset.z(), space.scales());
}

bool same_sample(const Fit& a, const Fit& b) { return a.x == b.x && a.y == b.y && a.layer == b.layer; }

/// Returns false if the quadratic has no extremum. Uses doubles, because sums of three floats are evaluated in another
/// order on arm64 than on x86.
bool solve(const ScaleSpace& space, int octave, Fit& fit) {
  const Samples samples(space, octave, fit.layer, fit.x, fit.y);
  fit.hessian = samples.hessian();
  const Eigen::Matrix3d hessian = fit.hessian.cast<double>();
  const Eigen::Vector3d gradient = samples.gradient().cast<double>();
  if (!(std::abs(hessian.determinant()) > 0.0)) return false;
  const Eigen::Vector3d offset = -(hessian.inverse() * gradient);
  fit.offset = offset.cast<float>();
  fit.value = samples.middle() + static_cast<float>(0.5 * gradient.dot(offset));
  return fit.offset.allFinite();
}

/// Moves from sample to sample until the extremum lies nearest to the sample from which it was computed. An extremum
/// halfway between two samples, or between two octaves, may lie nearer to another sample as seen from each; it is kept
/// too.
std::optional<Fit> fit_extremum(const ScaleSpace& space, int octave, int layer, int x, int y) {
  Fit before{-1, -1, -1}, fit{x, y, layer};
  for (int moves = 0; moves <= kMostMoves; ++moves) {
    if (!solve(space, octave, fit)) return std::nullopt;
    if (fit.offset.cwiseAbs().maxCoeff() <= 0.5F) return fit;
    Fit next = fit;
    move(space, octave, next);
    if (same_sample(next, fit) || same_sample(next, before)) break;
    before = fit;
    fit = next;
  }
  if (fit.offset.cwiseAbs().maxCoeff() <= kFarthest) return fit;
  return std::nullopt;
}

/// Lowe's test: a point is not on an edge if Tr^2 / Det < (r + 1)^2 / r for the curvatures in the image.
bool on_edge(const Matrix3f& hessian, float ratio) {
  const float trace = hessian(0, 0) + hessian(1, 1);
  const float determinant = hessian(0, 0) * hessian(1, 1) - hessian(0, 1) * hessian(0, 1);
  return !(determinant > 0.0F) || !(trace * trace * ratio < (ratio + 1.0F) * (ratio + 1.0F) * determinant);
}

KeyPoint key_point(const ScaleSpace& space, int octave, const Fit& fit) {
  const auto step = static_cast<float>(1 << octave);
  const float scale = static_cast<float>(fit.layer) + fit.offset.z();
  return {.x_px = step * (static_cast<float>(fit.x) + fit.offset.x()),
          .y_px = step * (static_cast<float>(fit.y) + fit.offset.y()),
          .sigma_px = step * space.sigma_px(scale),
          .response = std::abs(fit.value),
          .octave = octave,
          .layer = fit.layer};
}

/// Keeps the stronger half of the key points; returns the response that further ones must exceed.
float make_room(std::vector<KeyPoint>& key_points) {
  const auto middle = key_points.begin() + static_cast<std::ptrdiff_t>(key_points.size() / 2);
  std::nth_element(key_points.begin(), middle, key_points.end(), stronger);
  key_points.erase(middle, key_points.end());
  return std::ranges::max_element(key_points, stronger)->response;
}

/// Whether two key points are the same feature, found from two samples or in two octaves.
bool same_thing(const KeyPoint& a, const KeyPoint& b) {
  // kApart is in multiples of the smaller scale, kLarger is the greatest ratio of the scales
  constexpr float kApart = 0.5F, kLarger = 1.2F;
  const float smaller_px = std::min(a.sigma_px, b.sigma_px), larger_px = std::max(a.sigma_px, b.sigma_px);
  return larger_px < kLarger * smaller_px && hypotenuse(a.x_px - b.x_px, a.y_px - b.y_px) < kApart * smaller_px;
}

/// Keeps only the strongest of equal key points. Sorting from top to bottom limits each search to a few key points.
void drop_doubles(std::vector<KeyPoint>& key_points) {
  // No other key point matches a negative scale
  const auto drop = [](KeyPoint& point) { point.sigma_px = -point.sigma_px; };
  std::ranges::sort(key_points, [](const KeyPoint& a, const KeyPoint& b) {
    return a.y_px != b.y_px ? a.y_px < b.y_px : stronger(a, b);
  });
  for (std::size_t i = 0; i < key_points.size(); ++i) {
    for (std::size_t j = i + 1; j < key_points.size(); ++j) {
      KeyPoint &upper = key_points[i], &lower = key_points[j];
      if (lower.y_px - upper.y_px > upper.sigma_px) break;
      if (same_thing(upper, lower)) drop(stronger(upper, lower) ? lower : upper);
    }
  }
  std::erase_if(key_points, [](const KeyPoint& point) { return point.sigma_px < 0.0F; });
}

Neighbourhood around(const ScaleSpace& space, int octave, int layer, int y) {
  Neighbourhood rows{};
  for (int i = 0; i < 9; ++i) rows.rows[i] = space.difference(octave, layer - 1 + i / 3).row(y - 1 + i % 3);
  return rows;
}

}  // namespace

ExtremumFinder::ExtremumFinder(const SiftSettings& settings) : settings_(settings) {}

void ExtremumFinder::find(const ScaleSpace& space, const VisibleRegion& region, double contrast,
                          std::vector<KeyPoint>& out) {
  out.clear();
  out.reserve(kMost);
  least_sample_ = static_cast<float>(kSampledShare * contrast);
  least_response_ = static_cast<float>(contrast);
  for (int octave = 0; octave < space.octaves(); ++octave)
    for (int layer = 1; layer <= space.scales(); ++layer)
      for (int y = 1; y < space.difference(octave, 0).height() - 1; ++y)
        find_in_row(space, region, octave, layer, y, out);
  drop_doubles(out);
}

void ExtremumFinder::find_in_row(const ScaleSpace& space, const VisibleRegion& region, int octave, int layer, int y,
                                 std::vector<KeyPoint>& out) {
  const int width = space.difference(octave, 0).width();
  const VisibleRegion::Span span = region.span(y << octave);
  const int first = std::max(1, span.first >> octave), last = std::min(width - 1, span.last >> octave);
  if (first >= last) return;
  columns_.resize(as_size(region.side_px()));
  const int found =
      space.kernels().find_extrema(around(space, octave, layer, y), first, last, least_sample_, columns_.data());
  for (int i = 0; i < found; ++i) {
    const auto fit = fit_extremum(space, octave, layer, columns_[as_size(i)], y);
    if (!fit || !(std::abs(fit->value) >= least_response_)) continue;
    if (octave == 0 && static_cast<float>(fit->layer) + fit->offset.z() < kFinestScale) continue;
    if (on_edge(fit->hessian, static_cast<float>(settings_.curvature_ratio))) continue;
    const KeyPoint point = key_point(space, octave, *fit);
    const float needed_px = static_cast<float>(settings_.clearance_sigmas) * point.sigma_px;
    if (!(region.clearance_px(point.x_px, point.y_px) >= std::max(1.0F, needed_px))) continue;
    out.push_back(point);
    if (out.size() == kMost) least_response_ = make_room(out);
  }
}

}  // namespace azimuth
