#include "slam/perception/colour/colour_perception.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "slam/camera/make_camera.hpp"
#include "slam/geometry/index.hpp"
#include "slam/perception/colour/radial_line.hpp"
#include "slam/perception/colour/scan.hpp"

namespace azimuth {
namespace {

/// One run in so many samples is far beyond what any scene shows and bounds the time an image takes.
constexpr std::size_t kSamplesPerRun = 16;
constexpr std::size_t kFewestRuns = 64;

SampleSpace space_of(PixelFormat pixels) {
  const bool is_yuv = pixels == PixelFormat::yuyv || pixels == PixelFormat::uyvy || pixels == PixelFormat::nv12;
  return is_yuv ? SampleSpace::yuv : SampleSpace::rgb;
}

/// Samples of `side` x `side` pixels; the first one's middle is at (side - 1) / 2.
SampleGrid grid_about(const ImageAxes& axes, int side) {
  const double first_px = 0.5 * (side - 1);
  return {{first_px - axes.centre_px.x(), first_px / axes.beta - axes.centre_px.y()}, {side / 1.0, side / axes.beta}};
}

}  // namespace

ColourPerception::ColourPerception(const CameraRig& rig, const ColourSettings& settings)
    : image_rig_(rig.image), settings_(settings), sides_(settings) {}

void ColourPerception::observe(const ImageView& image, BearingSet& out) {
  out.clear();
  if (!image.readable() || !prepare(image.format) || !group_colours(image)) {
    out.trouble = ImageTrouble::unreadable;
    return;
  }
  for (const Blob& blob : blobs_.all())
    if (const std::optional<Bearing> bearing = bearing_of(blob)) out.bearings.push_back(*bearing);
}

/// Whether images like this can be used; lays out what does not change from one to the next.
bool ColourPerception::prepare(const FrameFormat& format) {
  if (!has_colour(format.pixels) || !is_size_of(format, image_rig_)) return false;
  const bool same_size = format.width_px == format_.width_px && format.height_px == format_.height_px;
  if (visible_ && same_size && format.pixels == format_.pixels) return true;
  format_ = format;
  ImageRig rig = image_rig_;
  rig.width_px = format.width_px;
  rig.height_px = format.height_px;
  axes_ = axes_of(rig);
  pixels_per_sample_ = pixels_per_sample(format.pixels);
  visible_.emplace(ImageMask(axes_, mask_of(rig)), format.width_px, format.height_px, pixels_per_sample_);
  if (!table_ || table_->space() != space_of(format.pixels)) table_.emplace(settings_, space_of(format.pixels));
  grid_ = grid_about(axes_, pixels_per_sample_);
  const std::size_t pixels = as_size(format.width_px) * as_size(format.height_px);
  runs_.resize(std::max(kFewestRuns, pixels / kSamplesPerRun));
  return true;
}

/// False when there are too many runs.
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
  bearing.sigma_rad = shape->sigma_rad;
  bearing.radius_px = shape->radius_px;
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
  const double fill = blob.area * grid_.step_px.prod() / (shape.length_px * shape.width_px);
  return elongation >= settings_.elongation_min && elongation <= settings_.elongation_max &&
         fill >= settings_.fill_min && fill <= settings_.fill_max;
}

std::optional<UprightShape> ColourPerception::upright_shape(const Blob& blob) {
  blobs_.runs_of(blob, runs_of_blob_);
  outline_of(runs_of_blob_, grid_, outline_);
  const auto is_background = [this](const CentredPoint& point) {
    const Eigen::Vector2d sample = (point - grid_.origin_px).cwiseQuotient(grid_.step_px);
    const int column = static_cast<int>(std::lround(sample.x())), row = static_cast<int>(std::lround(sample.y()));
    return visible_->contains(column, row) && blobs_.class_at(column, row) == 0;
  };
  return sides_.find(outline_, radial_line_rad(outline_), pixels_per_sample_, is_background);
}

}  // namespace azimuth
