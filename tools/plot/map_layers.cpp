#include "tools/plot/map_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/plot/map_view.hpp"

namespace azimuth {
namespace {

constexpr double kNameSize_px = 17.0;
constexpr double kThinning_px = 0.4;

Box box_about(const Eigen::Vector2d& middle_px, double radius_px) {
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(radius_px);
  return {middle_px - half, middle_px + half};
}

}  // namespace

MapLayers::MapLayers(PlotCanvas& canvas, const Axes& axes, const MapPicture& picture)
    : canvas_(canvas), axes_(axes), picture_(picture), view_m_((axes.shown_m().high - axes.shown_m().low).minCoeff()) {}

void MapLayers::draw() {
  canvas_.clip(axes_.top_left_px(), axes_.size_px());
  for (const PlotLine& piece : picture_.truth) draw_line(piece, kTruthColour, kTruthWidth_px);
  draw_line(picture_.odometry, kOdometryColour.with_alpha(0.85), kOdometryWidth_px);
  draw_line(picture_.calibrated, kCalibratedColour.with_alpha(0.85), kOdometryWidth_px);
  for (const UncertainPoint& pose : picture_.poses)
    draw_ellipse(pose, kEstimateColour.with_alpha(0.10), kEstimateColour.with_alpha(0.55), 1.2);
  draw_estimate();
  draw_line(picture_.smoothed, kSmoothedColour, kSmoothedWidth_px, kSmoothedDash_px);
  draw_landmarks();
  draw_ends();
  write_names();
  canvas_.release_clip();
}

PlotLine MapLayers::to_px(const PlotLine& line_m) const {
  PlotLine points;
  points.reserve(line_m.size());
  for (const Eigen::Vector2d& point : line_m) points.push_back(axes_.to_px(point));
  return points;
}

void MapLayers::draw_line(const PlotLine& line_m, const Colour& colour, double width_px, double dash_px) {
  for (const PlotLine& piece : clipped(to_px(line_m), axes_.frame_px())) {
    const PlotLine points = thinned(piece, kThinning_px);
    if (dash_px > 0.0)
      canvas_.dashed_line(points, colour, width_px, dash_px);
    else
      canvas_.line(points, colour, width_px);
  }
}

/// The fill fades faster than the edge, so that all ellipses need about the same ink.
void MapLayers::draw_ellipse(const UncertainPoint& point, const Colour& fill, const Colour& edge, double width_px) {
  const double ink = ellipse_ink(semi_major_m(point), view_m_);
  if (ink == 0.0 || !point.p_map_m.allFinite()) return;
  canvas_.polygon(to_px(ellipse_outline_m(point)), fill.with_alpha(ink * ink * fill.alpha),
                  edge.with_alpha(ink * edge.alpha), width_px);
}

void MapLayers::draw_estimate() {
  for (const PathPiece& piece : picture_.estimate)
    draw_line(piece.line, kEstimateColour, piece.lost ? kLostWidth_px : kEstimateWidth_px,
              piece.lost ? kLostDash_px : 0.0);
}

void MapLayers::draw_landmarks() {
  for (const Eigen::Vector2d& landmark : picture_.true_landmarks)
    if (is_shown(landmark)) draw_plus(canvas_, axes_.to_px(landmark));
  for (const PlottedLandmark& landmark : picture_.landmarks) {
    const Colour colour = style_of(picture_, landmark).colour;
    draw_ellipse(landmark.point, colour.with_alpha(0.22), colour, 2.0);
  }
  for (const PlottedLandmark& landmark : picture_.landmarks) {
    if (!is_shown(landmark.point.p_map_m)) continue;
    const Eigen::Vector2d at_px = axes_.to_px(landmark.point.p_map_m);
    if (is_well_known(landmark, view_m_))
      draw_marker(canvas_, at_px, style_of(picture_, landmark));
    else
      draw_hardly_known(canvas_, at_px);
  }
}

void MapLayers::draw_ends() {
  if (!picture_.estimate.empty() && !picture_.estimate.front().line.empty()) {
    const Eigen::Vector2d start = picture_.estimate.front().line.front();
    if (is_shown(start)) draw_start(canvas_, axes_.to_px(start));
  }
  if (!picture_.T_map_body || !is_shown(picture_.T_map_body->position())) return;
  const Pose2& T_map_body = *picture_.T_map_body;
  draw_robot(canvas_, axes_.to_px(T_map_body.position()),
             {std::cos(T_map_body.heading_rad), -std::sin(T_map_body.heading_rad)});
}

/// Marks landmarks and ellipses as occupied. Names also avoid paths where possible.
void MapLayers::take_landmarks(LabelSpace& space) const {
  for (const Eigen::Vector2d& landmark : picture_.true_landmarks)
    if (is_shown(landmark)) space.take(box_about(axes_.to_px(landmark), kPlusRadius_px));
  for (const PlottedLandmark& landmark : picture_.landmarks) {
    if (is_shown(landmark.point.p_map_m)) space.take(box_about(axes_.to_px(landmark.point.p_map_m), kMarkerRadius_px));
    if (ellipse_ink(semi_major_m(landmark.point), view_m_) == 0.0) continue;
    PlotLine outline = to_px(ellipse_outline_m(landmark.point));
    outline.push_back(outline.front());
    space.take(outline);
  }
  if (picture_.T_map_body) space.take(box_about(axes_.to_px(picture_.T_map_body->position()), kRobotRadius_px));
}

void MapLayers::write_names() {
  LabelSpace space(axes_.frame_px());
  take_landmarks(space);
  for (const PathPiece& piece : picture_.estimate) space.avoid(to_px(piece.line));
  for (const PlotLine& piece : picture_.truth) space.avoid(to_px(piece));
  space.avoid(to_px(picture_.odometry));
  space.avoid(to_px(picture_.calibrated));
  space.avoid(to_px(picture_.smoothed));
  const TextStyle style{kNameSize_px, kNameColour, false, Anchor::left};
  for (const PlottedLandmark& landmark : picture_.landmarks) {
    if (landmark.name.empty() || !is_shown(landmark.point.p_map_m) || !is_well_known(landmark, view_m_)) continue;
    const Eigen::Vector2d size{canvas_.text_width_px(landmark.name, style), 0.75 * kNameSize_px};
    const double near_px = kMarkerRadius_px + 5.0;
    const double beyond_px = std::min(axes_.to_px(semi_major_m(landmark.point)), 30.0) + near_px;
    const auto room = space.place(axes_.to_px(landmark.point.p_map_m), size, std::array{near_px, beyond_px});
    if (room) canvas_.text(landmark.name, {room->low.x(), room->high.y()}, style);
  }
}

LandmarkStyle style_of(const MapPicture& picture, const PlottedLandmark& landmark) {
  const auto number = static_cast<std::size_t>(landmark.kind);
  if (landmark.kind < 0 || number >= picture.kinds.size()) return plain_landmark_style();
  return landmark_style(picture.kinds[number], number);
}

void draw_plus(PlotCanvas& canvas, const Eigen::Vector2d& at_px) {
  const Eigen::Vector2d right{kPlusRadius_px, 0.0}, up{0.0, kPlusRadius_px};
  canvas.line(std::array<Eigen::Vector2d, 2>{at_px - right, at_px + right}, kInkColour, 1.8);
  canvas.line(std::array<Eigen::Vector2d, 2>{at_px - up, at_px + up}, kInkColour, 1.8);
}

void draw_hardly_known(PlotCanvas& canvas, const Eigen::Vector2d& at_px) { canvas.ring(at_px, 5.5, kFaintColour, 1.5); }

void draw_start(PlotCanvas& canvas, const Eigen::Vector2d& at_px) {
  canvas.disc(at_px, 9.0, kPaperColour);
  canvas.disc(at_px, 6.5, kEstimateColour);
}

void draw_robot(PlotCanvas& canvas, const Eigen::Vector2d& at_px, const Eigen::Vector2d& direction) {
  const Eigen::Vector2d side{-direction.y(), direction.x()};
  canvas.polygon(std::array<Eigen::Vector2d, 4>{{at_px + 20.0 * direction, at_px - 13.0 * direction + 13.0 * side,
                                                 at_px - 6.0 * direction, at_px - 13.0 * direction - 13.0 * side}},
                 kEstimateColour, kPaperColour, 2.0);
}

}  // namespace azimuth
