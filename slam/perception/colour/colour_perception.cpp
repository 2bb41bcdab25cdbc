#include "slam/perception/colour/colour_perception.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "slam/camera/make_camera.hpp"
#include "slam/geometry/index.hpp"
#include "slam/perception/colour/scan.hpp"

namespace azimuth {
namespace {

/// At most one run per this many samples, far more than real scenes have; the limit bounds the time of an image.
constexpr std::size_t kSamplesPerRun = 16;
constexpr std::size_t kFewestRuns = 64;

SampleSpace space_of(PixelFormat pixels) {
  const bool is_yuv = pixels == PixelFormat::yuyv || pixels == PixelFormat::uyvy || pixels == PixelFormat::nv12;
  return is_yuv ? SampleSpace::yuv : SampleSpace::rgb;
}

/// The grid of samples of `side` x `side` pixels; the centre of the first sample is at (side - 1) / 2.
SampleGrid grid_about(const ImageAxes& axes, int side) {
  const double first_px = 0.5 * (side - 1);
  return {{first_px - axes.centre_px.x(), first_px / axes.beta - axes.centre_px.y()}, {side / 1.0, side / axes.beta}};
}

Pixel pixel_of(const CentredPoint& point, const ImageAxes& axes) {
  return {point.x() + axes.centre_px.x(), axes.beta * (point.y() + axes.centre_px.y())};
}

CentredPoint centred(const Pixel& pixel, const ImageAxes& axes) {
  return {pixel.x() - axes.centre_px.x(), pixel.y() / axes.beta - axes.centre_px.y()};
}

}  // namespace

VisibleArea::VisibleArea(const ImageMask& mask, int width_px, int height_px, int pixels_per_sample)
    : width_(width_px / pixels_per_sample), height_(height_px / pixels_per_sample) {
  const std::vector<std::uint8_t> pixels = mask.raster(width_px, height_px);
  const auto all_visible = [&](int column, int row) {
    std::uint8_t all = 255;
    for (int v = row * pixels_per_sample; v < (row + 1) * pixels_per_sample; ++v)
      for (int u = column * pixels_per_sample; u < (column + 1) * pixels_per_sample; ++u)
        all &= pixels[as_size(v) * as_size(width_px) + as_size(u)];
    return all;
  };
  for (int row = 0; row < height_; ++row) {
    bool open = false;
    for (int column = 0; column < width_; ++column) {
      visible_.push_back(all_visible(column, row));
      const bool visible = visible_.back() != 0;
      if (visible && !open) spans_.push_back({static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(column), 0});
      if (visible) spans_.back().end = static_cast<std::uint16_t>(column + 1);
      open = visible;
    }
  }
}

ColourPerception::ColourPerception(const CameraRig& rig, const ColourSettings& settings)
    : camera_rig_(rig), settings_(settings), sides_(settings) {}

void ColourPerception::observe(const ImageView& image, BearingSet& out) {
  out.clear();
  if (!image.readable() || !prepare(image.format) || !group_colours(image)) {
    out.trouble = ImageTrouble::unreadable;
    return;
  }
  for (const Blob& blob : blobs_.all())
    if (const std::optional<Bearing> bearing = bearing_of(blob)) out.bearings.push_back(*bearing);
}

/// Prepares the members that depend on the format, if it changed. Returns false if images of this format cannot be
/// used.
bool ColourPerception::prepare(const FrameFormat& format) {
  if (!has_colour(format.pixels) || !is_size_of(format, camera_rig_.image)) return false;
  const bool same_size = format.width_px == format_.width_px && format.height_px == format_.height_px;
  if (visible_ && same_size && format.pixels == format_.pixels) return true;
  format_ = format;
  CameraRig rig = camera_rig_;
  rig.image.width_px = format.width_px;
  rig.image.height_px = format.height_px;
  axes_ = axes_of(rig.image);
  std::string ignored;  // The settings check rejects a tilt without a camera model that knows elevations
  if (!tilt_of(rig).is_level()) camera_ = camera_of(rig, ignored);
  pixels_per_sample_ = pixels_per_sample(format.pixels);
  visible_.emplace(ImageMask(axes_, mask_of(rig.image)), format.width_px, format.height_px, pixels_per_sample_);
  if (!table_ || table_->space() != space_of(format.pixels)) table_.emplace(settings_, space_of(format.pixels));
  grid_ = grid_about(axes_, pixels_per_sample_);
  const std::size_t pixels = as_size(format.width_px) * as_size(format.height_px);
  runs_.resize(std::max(kFewestRuns, pixels / kSamplesPerRun));
  return true;
}

/// Returns false if there are too many runs.
bool ColourPerception::group_colours(const ImageView& image) {
  const Scan scan{reinterpret_cast<const std::uint8_t*>(image.bytes.data()), image.format, table_->data(),
                  table_->least_chroma()};
  const std::size_t count = find_runs(scan, visible_->spans(), runs_);
  if (count > runs_.size()) return false;
  blobs_.group(std::span(runs_).first(count));
  return true;
}

std::optional<Bearing> ColourPerception::bearing_of(const Blob& blob) {
  if (!has_landmark_size(blob)) return std::nullopt;
  const std::optional<UprightShape> shape = upright_shape(blob);
  if (!shape || !has_landmark_shape(blob, *shape)) return std::nullopt;
  Bearing bearing;
  bearing.azimuth_rad = wrap(axes_.azimuth_direction * shape->angle_rad + axes_.azimuth_offset_rad);
  bearing.kind = blob.class_number - 1;
  bearing.radius_px = shape->radius_px;
  bearing.sigma_rad = shape->sigma_rad;
  return bearing;
}

bool ColourPerception::has_landmark_size(const Blob& blob) const {
  const double area_px2 = blob.area * grid_.step_px.prod();
  if (area_px2 < settings_.area_min_px2 || area_px2 > settings_.area_max_px2) return false;
  const double compact = compactness(blob.area, blob.perimeter);
  return compact >= settings_.compactness_min && compact <= settings_.compactness_max;
}

bool ColourPerception::has_landmark_shape(const Blob& blob, const UprightShape& shape) const {
  const double elongation = shape.length_px / shape.width_px;
  const double fill = level_area_px2(blob, shape) / (shape.length_px * shape.width_px);
  return elongation >= settings_.elongation_min && elongation <= settings_.elongation_max &&
         fill >= settings_.fill_min && fill <= settings_.fill_max;
}

std::optional<UprightShape> ColourPerception::upright_shape(const Blob& blob) {
  blobs_.runs_of(blob, runs_of_blob_);
  outline_of(runs_of_blob_, grid_, outline_);
  if (!level_outline()) return std::nullopt;
  const auto is_background = [this](const CentredPoint& level_point) {
    CentredPoint point = level_point;
    if (is_tilted()) {
      const auto pixel = camera_->tilted_pixel(pixel_of(level_point, axes_));
      if (!pixel) return false;
      point = centred(*pixel, axes_);
    }
    const Eigen::Vector2d sample = (point - grid_.origin_px).cwiseQuotient(grid_.step_px);
    const int column = static_cast<int>(std::lround(sample.x())), row = static_cast<int>(std::lround(sample.y()));
    return visible_->contains(column, row) && blobs_.class_at(column, row) == 0;
  };
  return sides_.find(outline_, radial_line_rad(outline_), pixels_per_sample_, is_background);
}

/// Levelling enlarges one side of the image and reduces the other. The factor follows from the solid angles that a
/// pixel covers in the tilted and in the level image.
double ColourPerception::level_area_px2(const Blob& blob, const UprightShape& shape) const {
  const double area_px2 = blob.area * grid_.step_px.prod();
  if (!is_tilted()) return area_px2;
  const Pixel level =
      pixel_of(shape.radius_px * CentredPoint(std::cos(shape.angle_rad), std::sin(shape.angle_rad)), axes_);
  const auto pixel = camera_->tilted_pixel(level);
  const auto here = pixel ? camera_->direction_jacobian(*pixel) : std::nullopt;
  const auto there = camera_->upright().direction_jacobian(level);
  return here && there ? area_px2 * std::abs(here->determinant() / there->determinant()) : area_px2;
}

/// Maps the outline to the image of a level camera. Returns false if a part of it would lie outside that image.
bool ColourPerception::level_outline() {
  if (!is_tilted()) return true;
  for (CentredPoint& point : outline_) {
    const auto level = camera_->level_pixel(pixel_of(point, axes_));
    if (!level) return false;
    point = centred(*level, axes_);
  }
  return true;
}

}  // namespace azimuth
