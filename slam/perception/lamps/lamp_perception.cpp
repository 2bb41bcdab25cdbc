#include "slam/perception/lamps/lamp_perception.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "slam/camera/make_camera.hpp"
#include "slam/geometry/index.hpp"
#include "slam/perception/image/gray.hpp"

namespace azimuth {
namespace {

constexpr double kLowest_rad = 0.02;  // Nearer to the horizon, a pixel covers too large a part of the ceiling

struct CeilingPoint {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< Along the robot's axes, in ceiling heights
  double pixel_area = 0.0;                       ///< Ceiling area that one pixel covers there
};

std::optional<CeilingPoint> ceiling_point(const CameraModel& camera, const Pixel& pixel) {
  const auto direction = camera.direction(pixel);
  if (!direction || direction->elevation_rad < kLowest_rad) return std::nullopt;
  const auto jacobian = camera.direction_jacobian(pixel);
  const double sine = std::sin(direction->elevation_rad), cosine = std::cos(direction->elevation_rad);
  const double distance = cosine / sine;
  // The solid angle of the pixel, then the ceiling area that subtends it: dA = dOmega / sin^3. The bound on the cosine
  // handles the zenith.
  const double solid_angle = std::abs(jacobian->determinant()) * std::max(cosine, 1e-9);
  return CeilingPoint{{distance * std::cos(direction->azimuth_rad), distance * std::sin(direction->azimuth_rad)},
                      solid_angle / (sine * sine * sine)};
}

using Points = std::array<CeilingPoint, 4>;

/// Four points on the axes of the spread, sqrt(2) standard deviations from the centroid: they have the spread's
/// covariance.
std::optional<Points> sample(const CameraModel& camera, const Pixel& centroid, const Eigen::Matrix2d& spread_px2) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(spread_px2);
  Points points;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto axis = as_index(k / 2);
    const double length_px = std::sqrt(2.0 * std::max(axes.eigenvalues()[axis], 0.0)) * (k % 2 == 0 ? 1.0 : -1.0);
    const auto point = ceiling_point(camera, centroid + length_px * axes.eigenvectors().col(axis));
    if (!point) return std::nullopt;
    points[k] = *point;
  }
  return points;
}

std::optional<CameraModel> model_of(CameraRig rig, int width_px, int height_px) {
  if (!rig.image.width_px) rig.image.width_px = width_px;
  if (!rig.image.height_px) rig.image.height_px = height_px;
  std::string ignored;
  return camera_of(rig, ignored);
}

/// Returns 255 for pixels that see a direction above `min_elevation_rad` and are not masked, else 0.
std::vector<std::uint8_t> visible_pixels(const CameraModel& camera, const MaskShape& mask, double min_elevation_rad,
                                         int width_px, int height_px) {
  std::vector<std::uint8_t> visible = ImageMask(camera.axes(), mask).raster(width_px, height_px);
  std::uint8_t* pixel = visible.data();
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u, ++pixel) {
      if (*pixel == 0) continue;
      const auto direction = camera.direction({u, v});
      if (!direction || direction->elevation_rad < min_elevation_rad) *pixel = 0;
    }
  }
  return visible;
}

/// The share of a slanted lamp's light that the threshold removes in some places along the lamp and not in others, as
/// the amplitude of a wave. With the threshold at half the lamp's brightness, a lamp that is t pixels thick keeps t / 2
/// of its light where its outline is between pixels, and (t - 1) / 2 where it is in the middle of them
/// (docs/mathematics.md, VI.27).
double share_cut(const LampBlob& blob) { return 0.5 / std::max(blob.rectangle().thickness_px - 0.5, 0.5); }

/// The Jacobian stops the growth of the azimuth's variance at ImageAxes::kNearCentre_px, which is too far out for a
/// spot known to a tenth of a pixel. This function lets the variance grow up to that of an unknown azimuth.
double near_centre(double variance_rad2, double radius_px) {
  constexpr double kNothingKnown_rad2 = kPi * kPi / 3.0;
  const double nearer = ImageAxes::kNearCentre_px / std::clamp(radius_px, 1e-6, ImageAxes::kNearCentre_px);
  return std::min(variance_rad2 * nearer * nearer, kNothingKnown_rad2);
}

}  // namespace

std::optional<CeilingPatch> ceiling_patch(const CameraModel& camera, const Pixel& centroid,
                                          const Eigen::Matrix2d& spread_px2) {
  const auto points = sample(camera, centroid, spread_px2);
  if (!points) return std::nullopt;
  double area = 0.0;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const CeilingPoint& point : *points) {
    area += point.pixel_area;
    middle += point.pixel_area * point.at;
  }
  middle /= area;
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const CeilingPoint& point : *points)
    moments += point.pixel_area / area * (point.at - middle) * (point.at - middle).transpose();

  const auto pixel = camera.pixel(Eigen::Vector3d(middle.x(), middle.y(), 1.0));
  if (!pixel) return std::nullopt;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(moments, Eigen::EigenvaluesOnly);
  // A rectangle with sides a and b has moments a^2 / 12 and b^2 / 12.
  const Eigen::Array2d sides = (12.0 * axes.eigenvalues().array().max(0.0)).sqrt();
  return CeilingPatch{*pixel, sides[1], sides[0] * sides[1]};
}

LampPerception::LampPerception(const CameraRig& rig, const LampSettings& settings)
    : rig_(rig),
      settings_(settings),
      sigma_place_px_(rig.image.sigma_px.value_or(settings.sigma_place_px)),
      finder_(settings) {
  blobs_.reserve(LampFinder::kMostRuns);
  lamps_.reserve(LampFinder::kMostRuns);
}

void LampPerception::lay_out(int width_px, int height_px) {
  camera_ = model_of(rig_, width_px, height_px);
  table_.reset();
  gray_.resize(width_px, height_px);
  const auto nothing = std::vector<std::uint8_t>(as_size(width_px) * as_size(height_px));
  visible_ = VisibleRows(
      camera_ ? visible_pixels(*camera_, mask_of(rig_.image), settings_.min_elevation_rad, width_px, height_px)
              : nothing,
      width_px, height_px);
  if (camera_ && settings_.inverse == CameraInverse::table) table_.emplace(*camera_, width_px, height_px);
}

void LampPerception::observe(const ImageView& image, BearingSet& out) {
  out.clear();
  lamps_.clear();
  if (!image.readable() || !is_size_of(image.format, rig_.image)) {
    out.trouble = ImageTrouble::unreadable;
    return;
  }
  if (visible_.width_px() != image.format.width_px || visible_.height_px() != image.format.height_px)
    lay_out(image.format.width_px, image.format.height_px);

  finder_.find(gray(image), visible_, blobs_);
  for (const LampBlob& blob : blobs_) {
    const auto found = lamp(blob);
    const auto seen = found ? bearing(*found) : std::nullopt;
    if (!seen) continue;
    lamps_.push_back(*found);
    out.bearings.push_back(*seen);
  }
}

/// Returns the image itself if its format has a plane of brightness.
GrayView LampPerception::gray(const ImageView& image) {
  const int width_px = image.format.width_px, height_px = image.format.height_px;
  const bool is_gray = image.format.pixels == PixelFormat::gray8 || image.format.pixels == PixelFormat::nv12;
  if (is_gray) return {image.row(0), image.format.stride_bytes, width_px, height_px};
  for (int v = 0; v < height_px; ++v) gray_row(image, v, 0, width_px, gray_.row(v));
  return {gray_.row(0), gray_.stride(), width_px, height_px};
}

std::optional<DetectedLamp> LampPerception::lamp(const LampBlob& blob) const {
  const Eigen::Matrix2d sharp_px2 =
      blob.spread_px2 - std::min(settings_.blur_px * settings_.blur_px, blob.spread_px2.diagonal().minCoeff()) *
                            Eigen::Matrix2d::Identity();
  const auto patch = ceiling_patch(*camera_, blob.centroid, sharp_px2);
  if (!patch || patch->length_heights > settings_.max_length_heights ||
      patch->area_heights2 > settings_.max_area_heights2)
    return std::nullopt;
  return DetectedLamp{patch->middle, covariance_px2(blob), blob};
}

/// Covariance of the lamp's position: pixel noise at its distance from the centroid over the blob's weight, uneven
/// light, the varying loss of light by the threshold, and all other errors.
Eigen::Matrix2d LampPerception::covariance_px2(const LampBlob& blob) const {
  const double noise = finder_.light().noise / blob.weight;
  const double uneven = settings_.sigma_per_spread, cut = settings_.sigma_per_cut_spread * share_cut(blob);
  return (noise * noise * blob.area_px + uneven * uneven + cut * cut) * blob.spread_px2 +
         sigma_place_px_ * sigma_place_px_ * Eigen::Matrix2d::Identity();
}

std::optional<Bearing> LampPerception::bearing(const DetectedLamp& lamp) const {
  const auto jacobian = camera_->direction_jacobian(lamp.pixel);
  auto direction = camera_->direction(lamp.pixel);
  const auto level_pixel = camera_->level_pixel(lamp.pixel);
  if (!jacobian || !direction || !level_pixel) return std::nullopt;
  const double radius_px = camera_->axes().polar(*level_pixel).radius_px;
  Eigen::Vector2d variance = (*jacobian * lamp.covariance_px2 * jacobian->transpose()).diagonal();
  variance.x() = near_centre(variance.x(), radius_px);
  if (table_) {
    const auto cell = table_->at(lamp.pixel);
    if (!cell) return std::nullopt;
    direction = cell->middle;
    variance = variance.cwiseMax(cell->half_rad.cwiseAbs2() / 3.0);  // Of a uniform distribution
  }
  Bearing bearing;
  bearing.azimuth_rad = direction->azimuth_rad;
  bearing.elevation_rad = direction->elevation_rad;
  bearing.sigma_rad = std::sqrt(variance.x());
  bearing.sigma_elevation_rad = std::sqrt(variance.y());
  bearing.radius_px = radius_px;
  return bearing;
}

}  // namespace azimuth
