#include "tools/plot/map_picture.hpp"

#include <cmath>
#include <limits>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/principal_axes.hpp"
#include "tools/plot/axes.hpp"
#include "tools/plot/legend.hpp"
#include "tools/plot/map_layers.hpp"
#include "tools/plot/map_view.hpp"

namespace azimuth {
namespace {

constexpr double kWidth_px = 1600.0;
constexpr double kLeft_px = 110.0, kRight_px = 40.0, kLegendTop_px = 112.0, kBottom_px = 80.0, kNote_px = 40.0;
constexpr double kInner_px = kWidth_px - kLeft_px - kRight_px;

Axes axes_below(double top_px, const MapPicture& picture) {
  return {view_of(picture), {kLeft_px, top_px}, kInner_px, 420.0, 1150.0};
}

/// The matrix that maps the unit circle to the ellipse about the origin.
Eigen::Matrix2d half_axes_m(const Eigen::Matrix2d& covariance_m2) {
  const PrincipalAxes axes = principal_axes(covariance_m2);
  return axes.directions * axes.eigenvalues.cwiseMax(0.0).cwiseSqrt().asDiagonal() * kDrawnSigmas;
}

}  // namespace

PlotCanvas drawn_map(const MapPicture& picture, PlotFormat format) {
  PlotCanvas ruler(1, 1, kPaperColour);
  const Legend legend(ruler, legend_entries(picture, axes_below(0.0, picture).shown_m()), kInner_px);
  const Axes axes = axes_below(kLegendTop_px + legend.height_px() + 14.0, picture);
  const std::string note = words(left_out(picture, axes.shown_m()), picture.landmark_word);
  const double axes_end_px = axes.frame_px().high.y() + kBottom_px;
  PlotCanvas canvas(static_cast<int>(kWidth_px),
                    static_cast<int>(std::lround(axes_end_px + (note.empty() ? 0.0 : kNote_px))), kPaperColour, format);
  canvas.text(picture.title, {kLeft_px, 56.0}, {34.0, kInkColour, true, Anchor::left});
  canvas.text(picture.subtitle, {kLeft_px, 94.0}, {22.0, kFaintColour, false, Anchor::left});
  legend.draw(canvas, {kLeft_px, kLegendTop_px});
  axes.draw(canvas);
  MapLayers(canvas, axes, picture).draw();
  canvas.text(note, {kLeft_px, axes_end_px + 14.0}, {19.0, kFaintColour, false, Anchor::left});
  return canvas;
}

std::optional<std::string> write_map_picture(const MapPicture& picture, const std::filesystem::path& file) {
  const std::optional<PlotFormat> format = plot_format(file);
  if (!format) return "the name of a picture must end in .png, .svg or .pdf";
  return drawn_map(picture, *format).write(file);
}

double semi_major_m(const UncertainPoint& point) {
  if (!point.covariance_m2.allFinite()) return std::numeric_limits<double>::infinity();
  return half_axes_m(point.covariance_m2).colwise().norm().maxCoeff();
}

std::vector<Eigen::Vector2d> ellipse_outline_m(const UncertainPoint& point) {
  constexpr int kCorners = 48;
  const Eigen::Matrix2d half_axes = half_axes_m(point.covariance_m2);
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2.0 * kPi * i / kCorners;
    corners.emplace_back(point.p_map_m + half_axes * Eigen::Vector2d{std::cos(angle), std::sin(angle)});
  }
  return corners;
}

double ellipse_ink(double semi_major_m, double view_m) {
  constexpr double kFull = 0.05, kGone = 0.5;  // semi-major axis as a fraction of the view
  const double share = semi_major_m / view_m;
  if (!(share <= kGone)) return 0.0;
  return share <= kFull ? 1.0 : kFull / share;
}

}  // namespace azimuth
