#include "slam/perception/sift/extrema.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

namespace azimuth {
namespace {

using Eigen::Matrix3f;
using Eigen::Vector3f;

// An extremum of the samples may be this much weaker than that of the function fitted to them.
constexpr double kSampledShare = 0.8;
constexpr int kMostMoves = 5;

/// A sample of the difference of Gaussians and those around it; axes are x, y and scale.
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

/// Where the quadratic through the samples has its extremum.
struct Fit {
  int x = 0, y = 0, layer = 0;         ///< sample nearest to it
  Vector3f offset = Vector3f::Zero();  ///< from there
  float value = 0.0F;
  Matrix3f hessian = Matrix3f::Zero();
};

bool inside(const ScaleSpace& space, int octave, const Fit& fit) {
  const Plane<float>& plane = space.difference(octave, 0);
  return fit.layer >= 1 && fit.layer <= space.scales() && fit.x >= 1 && fit.y >= 1 && fit.x < plane.width() - 1 &&
         fit.y < plane.height() - 1;
}

/// Moves from sample to sample until the extremum is nearest to the one it is computed from.
std::optional<Fit> fit_extremum(const ScaleSpace& space, int octave, int layer, int x, int y) {
  Fit fit{x, y, layer};
  for (int move = 0; move <= kMostMoves && inside(space, octave, fit); ++move) {
    const Samples samples(space, octave, fit.layer, fit.x, fit.y);
    const Vector3f gradient = samples.gradient();
    fit.hessian = samples.hessian();
    const float determinant = fit.hessian.determinant();
    if (!(std::abs(determinant) > 0.0F)) return std::nullopt;
    fit.offset = -(fit.hessian.inverse() * gradient);
    if (!(fit.offset.cwiseAbs().maxCoeff() < 1e3F)) return std::nullopt;
    fit.value = samples.middle() + 0.5F * gradient.dot(fit.offset);
    if (fit.offset.cwiseAbs().maxCoeff() <= 0.5F) return fit;
    fit.x += static_cast<int>(std::lround(fit.offset.x()));
    fit.y += static_cast<int>(std::lround(fit.offset.y()));
    fit.layer += static_cast<int>(std::lround(fit.offset.z()));
  }
  return std::nullopt;
}

/// Lowe: Tr^2 / Det < (r + 1)^2 / r for the curvatures across the image.
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

/// Half of them, the strongest; gives the response that newcomers must beat.
float make_room(std::vector<KeyPoint>& key_points) {
  const auto middle = key_points.begin() + static_cast<std::ptrdiff_t>(key_points.size() / 2);
  std::nth_element(key_points.begin(), middle, key_points.end(), stronger);
  key_points.erase(middle, key_points.end());
  return std::ranges::max_element(key_points, stronger)->response;
}

Neighbourhood around(const ScaleSpace& space, int octave, int layer, int y) {
  Neighbourhood rows{};
  for (int i = 0; i < 9; ++i) rows.rows[i] = space.difference(octave, layer - 1 + i / 3).row(y - 1 + i % 3);
  return rows;
}

}  // namespace

ExtremumFinder::ExtremumFinder(const SiftSettings& settings) : settings_(settings) {}

void ExtremumFinder::find(const ScaleSpace& space, const VisibleRegion& region, std::vector<KeyPoint>& out) {
  out.clear();
  out.reserve(kMost);
  least_response_ = static_cast<float>(settings_.contrast);
  for (int octave = 0; octave < space.octaves(); ++octave)
    for (int layer = 1; layer <= space.scales(); ++layer)
      for (int y = 1; y < space.difference(octave, 0).height() - 1; ++y)
        find_in_row(space, region, octave, layer, y, out);
}

void ExtremumFinder::find_in_row(const ScaleSpace& space, const VisibleRegion& region, int octave, int layer, int y,
                                 std::vector<KeyPoint>& out) {
  const int width = space.difference(octave, 0).width();
  const VisibleRegion::Span span = region.span(y << octave);
  const int first = std::max(1, span.first >> octave), last = std::min(width - 1, span.last >> octave);
  if (first >= last) return;
  columns_.resize(static_cast<std::size_t>(region.side_px()));
  const int found =
      space.kernels().find_extrema(around(space, octave, layer, y), first, last,
                                   static_cast<float>(kSampledShare * settings_.contrast), columns_.data());
  for (int i = 0; i < found; ++i) {
    const auto fit = fit_extremum(space, octave, layer, columns_[static_cast<std::size_t>(i)], y);
    if (!fit || !(std::abs(fit->value) >= least_response_)) continue;
    if (on_edge(fit->hessian, static_cast<float>(settings_.curvature_ratio))) continue;
    const KeyPoint point = key_point(space, octave, *fit);
    const float needed_px = static_cast<float>(settings_.clearance_sigmas) * point.sigma_px;
    if (!(region.clearance_px(point.x_px, point.y_px) >= std::max(1.0F, needed_px))) continue;
    out.push_back(point);
    if (out.size() == kMost) least_response_ = make_room(out);
  }
}

}  // namespace azimuth
