#include "tools/plot/map_picture.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "slam/geometry/angle.hpp"
#include "tools/plot/axes.hpp"
#include "tools/plot/canvas.hpp"
#include "tools/plot/extent.hpp"

namespace azimuth {
namespace {

// Colours of Okabe and Ito, told apart by every kind of colour vision; truth is grey so that it stands back.
constexpr Colour kPaper{1.0, 1.0, 1.0};
constexpr Colour kInk{0.13, 0.14, 0.16};
constexpr Colour kFaint{0.40, 0.42, 0.45};
constexpr Colour kEstimate{0.0, 0.447, 0.698};
constexpr Colour kOdometry{0.835, 0.369, 0.0};
constexpr Colour kLandmark{0.0, 0.62, 0.451};
constexpr Colour kTruth{0.74, 0.76, 0.78};

constexpr double kWidth_px = 1600.0;
constexpr double kLeft_px = 110.0, kRight_px = 40.0, kTop_px = 170.0, kBottom_px = 80.0;
constexpr double kSigmas = 2.0;

std::vector<Eigen::Vector2d> ellipse_px(const UncertainPoint& point, const Axes& axes) {
  constexpr int kCorners = 48;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(point.covariance_m2);
  const Eigen::Matrix2d half_axes =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() * kSigmas;
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * kPi * i / kCorners;
    corners.push_back(axes.to_px(point.p_map_m + half_axes * Eigen::Vector2d{std::cos(angle), std::sin(angle)}));
  }
  return corners;
}

void draw_plus(PlotCanvas& canvas, const Eigen::Vector2d& at_px, double radius_px) {
  const Eigen::Vector2d right{radius_px, 0.0}, up{0.0, radius_px};
  canvas.line(std::array<Eigen::Vector2d, 2>{at_px - right, at_px + right}, kInk, 1.8);
  canvas.line(std::array<Eigen::Vector2d, 2>{at_px - up, at_px + up}, kInk, 1.8);
}

/// An arrow head that points where the robot looks (`direction` in pixels, so y down).
void draw_robot(PlotCanvas& canvas, const Eigen::Vector2d& at_px, const Eigen::Vector2d& direction) {
  const Eigen::Vector2d side{-direction.y(), direction.x()};
  canvas.polygon(std::array<Eigen::Vector2d, 4>{{at_px + 20.0 * direction, at_px - 13.0 * direction + 13.0 * side,
                                                 at_px - 6.0 * direction, at_px - 13.0 * direction - 13.0 * side}},
                 kEstimate, kPaper, 2.0);
}

/// The map proper, back to front.
class MapLayers {
 public:
  MapLayers(PlotCanvas& canvas, const Axes& axes, const MapPicture& picture)
      : canvas_(canvas), axes_(axes), picture_(picture) {}

  void draw() {
    canvas_.clip(axes_.top_left_px(), axes_.size_px());
    for (const PlotLine& piece : picture_.truth) canvas_.line(to_px(piece), kTruth, 9.0);
    canvas_.line(to_px(picture_.odometry), kOdometry.with_alpha(0.85), 2.0);
    for (const UncertainPoint& pose : picture_.poses)
      canvas_.polygon(ellipse_px(pose, axes_), kEstimate.with_alpha(0.10), kEstimate.with_alpha(0.55), 1.2);
    canvas_.line(to_px(picture_.estimate), kEstimate, 2.6);
    draw_landmarks();
    draw_ends();
    canvas_.release_clip();
  }

 private:
  std::vector<Eigen::Vector2d> to_px(const PlotLine& line) const {
    std::vector<Eigen::Vector2d> points;
    points.reserve(line.size());
    for (const Eigen::Vector2d& point : line) points.push_back(axes_.to_px(point));
    return points;
  }

  void draw_landmarks() {
    for (const Eigen::Vector2d& landmark : picture_.true_landmarks) draw_plus(canvas_, axes_.to_px(landmark), 9.0);
    for (const UncertainPoint& landmark : picture_.landmarks)
      canvas_.polygon(ellipse_px(landmark, axes_), kLandmark.with_alpha(0.22), kLandmark, 2.0);
    for (const UncertainPoint& landmark : picture_.landmarks)
      canvas_.disc(axes_.to_px(landmark.p_map_m), 3.5, kLandmark);
  }

  void draw_ends() {
    if (!picture_.estimate.empty()) {
      canvas_.disc(axes_.to_px(picture_.estimate.front()), 9.0, kPaper);
      canvas_.disc(axes_.to_px(picture_.estimate.front()), 6.5, kEstimate);
    }
    if (!picture_.T_map_body) return;
    const Pose2& T_map_body = *picture_.T_map_body;
    draw_robot(canvas_, axes_.to_px(T_map_body.position()),
               {std::cos(T_map_body.heading_rad), -std::sin(T_map_body.heading_rad)});
  }

  PlotCanvas& canvas_;
  const Axes& axes_;
  const MapPicture& picture_;
};

/// A row of symbols and words above the map.
class Legend {
 public:
  Legend(PlotCanvas& canvas, const Eigen::Vector2d& at_px) : canvas_(canvas), at_px_(at_px) {}

  void entry(const std::string& words, const std::function<void(const Eigen::Vector2d& centre_px)>& symbol) {
    constexpr double kSymbol_px = 44.0, kGap_px = 34.0;
    const TextStyle style{20.0, kInk, false, Anchor::left};
    symbol(at_px_ + Eigen::Vector2d{kSymbol_px / 2, -7.0});
    canvas_.text(words, at_px_ + Eigen::Vector2d{kSymbol_px + 10.0, 0.0}, style);
    at_px_.x() += kSymbol_px + 10.0 + canvas_.text_width_px(words, style) + kGap_px;
  }

  void line(const std::string& words, const Colour& colour, double width_px) {
    entry(words, [&](const Eigen::Vector2d& centre_px) {
      const Eigen::Vector2d half{20.0, 0.0};
      canvas_.line(std::array<Eigen::Vector2d, 2>{centre_px - half, centre_px + half}, colour, width_px);
    });
  }

 private:
  PlotCanvas& canvas_;
  Eigen::Vector2d at_px_;
};

void draw_legend(PlotCanvas& canvas, const MapPicture& picture) {
  Legend legend(canvas, {kLeft_px, kTop_px - 24.0});
  if (!picture.estimate.empty()) legend.line("estimated path", kEstimate, 2.6);
  if (!picture.truth.empty()) legend.line("true path", kTruth, 9.0);
  if (!picture.odometry.empty()) legend.line("wheel odometry alone", kOdometry, 2.0);
  if (!picture.landmarks.empty())
    legend.entry("landmark, 2\u03c3", [&](const Eigen::Vector2d& centre_px) {
      std::vector<Eigen::Vector2d> oval;
      for (int i = 0; i < 48; ++i) {
        const double angle = 2.0 * kPi * i / 48;
        oval.emplace_back(centre_px + Eigen::Vector2d{18.0 * std::cos(angle), 9.0 * std::sin(angle)});
      }
      canvas.polygon(oval, kLandmark.with_alpha(0.22), kLandmark, 2.0);
      canvas.disc(centre_px, 3.5, kLandmark);
    });
  if (!picture.true_landmarks.empty())
    legend.entry("true landmark", [&](const Eigen::Vector2d& centre_px) { draw_plus(canvas, centre_px, 9.0); });
  if (picture.T_map_body)
    legend.entry("robot at the end", [&](const Eigen::Vector2d& centre_px) {
      draw_robot(canvas, centre_px, {1.0, 0.0});
    });
}

Extent shown(const MapPicture& picture) {
  Extent trusted, others;
  for (const PlotLine& piece : picture.truth) trusted.include(piece);
  trusted.include(picture.true_landmarks);
  if (trusted.empty) trusted.include(picture.estimate);
  others.include(picture.estimate);
  others.include(picture.odometry);
  for (const UncertainPoint& landmark : picture.landmarks) others.include(landmark.p_map_m);
  const double reach_m = trusted.empty ? 0.0 : 0.15 * trusted.size_m().maxCoeff();
  const Extent extent = trusted.stretched(others, reach_m);
  return extent.padded(std::max(0.5, 0.03 * extent.size_m().maxCoeff()));
}

}  // namespace

std::optional<std::string> write_png(const MapPicture& picture, const std::string& file) {
  const Axes axes(shown(picture), {kLeft_px, kTop_px}, kWidth_px - kLeft_px - kRight_px, 420.0, 1150.0);
  const double height_px = kTop_px + axes.size_px().y() + kBottom_px;
  PlotCanvas canvas(static_cast<int>(kWidth_px), static_cast<int>(std::lround(height_px)), kPaper);
  canvas.text(picture.title, {kLeft_px, 56.0}, {34.0, kInk, true, Anchor::left});
  canvas.text(picture.subtitle, {kLeft_px, 96.0}, {22.0, kFaint, false, Anchor::left});
  draw_legend(canvas, picture);
  axes.draw(canvas);
  MapLayers(canvas, axes, picture).draw();
  return canvas.write_png(file);
}

}  // namespace azimuth
