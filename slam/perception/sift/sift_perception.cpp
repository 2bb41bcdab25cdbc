#include "slam/perception/sift/sift_perception.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "slam/camera/make_camera.hpp"
#include "slam/geometry/same_everywhere.hpp"
#include "slam/perception/sift/neighbours.hpp"
#include "slam/perception/sift/opencv_sift.hpp"
#include "slam/perception/sift/own_sift.hpp"

namespace azimuth {
namespace {

std::unique_ptr<FeatureFinder> make_finder(const SiftSettings& settings) {
  if (settings.detector == SiftDetector::opencv) return opencv_sift(settings);
  return std::make_unique<OwnSift>(settings);
}

std::optional<CameraModel> model_of(const CameraRig& rig) {
  std::string ignored;  // A rig without elevations is permitted
  return camera_of(rig, ignored);
}

/// Radius of the disc to process: to the mirror's rim, or to the farthest image edge if the rig does not give the rim.
double disc_radius_px(const CameraRig& rig, const ImageAxes& axes, int width_px, int height_px) {
  const double u = axes.centre_px.x(), v = axes.centre_px.y(), last_v = (height_px - 1) / axes.beta;
  const double farthest_px = std::max({u, width_px - 1 - u, v, last_v - v, 1.0});
  return std::clamp(rig.image.mask_outer_px.value_or(farthest_px), 1.0, farthest_px);
}

}  // namespace

SiftPerception::SiftPerception(const CameraRig& rig, const SiftSettings& settings)
    : rig_(rig), settings_(settings), camera_(model_of(rig)), finder_(make_finder(settings)) {}

void SiftPerception::lay_out(int width_px, int height_px) {
  ImageRig image = rig_.image;
  if (!image.width_px) image.width_px = width_px;
  if (!image.height_px) image.height_px = height_px;
  const ImageAxes axes = axes_of(image);
  square_ = azimuth::working_square(axes, disc_radius_px(rig_, axes, width_px, height_px), settings_.side_px);
  layout_.emplace(Layout{WorkingImage(square_, width_px, height_px),
                         VisibleRegion(square_, mask_of(image), width_px, height_px),
                         FeatureSelection(settings_, square_.middle_px())});
}

void SiftPerception::observe(const ImageView& image, BearingSet& out) {
  out.clear();
  key_points_.clear();
  if (!image.readable() || !is_size_of(image.format, rig_.image)) {
    out.trouble = ImageTrouble::unreadable;
    return;
  }
  const int width_px = image.format.width_px, height_px = image.format.height_px;
  if (!layout_ || layout_->image.width_px() != width_px || layout_->image.height_px() != height_px)
    lay_out(width_px, height_px);

  layout_->image.make(image, image_);
  layout_->region.fill(image_);
  finder_->detect(image_, layout_->region, key_points_);
  layout_->selection.select(key_points_);
  finder_->describe(key_points_, out.descriptors);
  find_neighbours(key_points_, out.neighbours);
  for (const KeyPoint& point : key_points_) out.bearings.push_back(bearing(point));
}

Bearing SiftPerception::bearing(const KeyPoint& point) const {
  const Pixel pixel = square_.camera_pixel(point.x_px, point.y_px);
  const double from_centre_px =
      std::max(1.0, hypotenuse(point.x_px - square_.middle_px(), point.y_px - square_.middle_px()));
  Bearing bearing;
  // Without a tilt, azimuths need only the image's axes.
  const PolarPixel polar = square_.axes.polar(camera_ ? camera_->level_pixel(pixel).value_or(pixel) : pixel);
  bearing.azimuth_rad = polar.azimuth_rad;
  bearing.radius_px = polar.radius_px;
  bearing.sigma_rad =
      hypotenuse(settings_.sigma_place_px, settings_.sigma_place_per_scale * point.sigma_px) / from_centre_px;
  if (!camera_) return bearing;
  const auto direction = camera_->direction(pixel);
  if (!direction) return bearing;
  bearing.elevation_rad = direction->elevation_rad;
  // No filter estimates a tilt from features (mathematics VI.34), so the rig's tilt uncertainty counts as noise.
  if (const double sigma_tilt_rad = rig_.sigma_tilt_rad.value_or(0.0); sigma_tilt_rad > 0.0)
    bearing.sigma_rad =
        hypotenuse(bearing.sigma_rad, std::sqrt(azimuth_variance_by_tilt(sigma_tilt_rad, direction->elevation_rad)));
  return bearing;
}

}  // namespace azimuth
