#include "slam/perception/sift/sift_perception.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <span>
#include <string>

#include "slam/camera/make_camera.hpp"
#include "slam/geometry/index.hpp"
#include "slam/geometry/same_everywhere.hpp"
#include "slam/perception/sift/own_sift.hpp"

namespace azimuth {
namespace {

Neighbours nearest_to(std::size_t place, std::span<const KeyPoint> key_points) {
  Neighbours nearest;
  std::array<float, Neighbours::kMost> distance_px;
  distance_px.fill(std::numeric_limits<float>::infinity());
  for (std::size_t other = 0; other < key_points.size(); ++other) {
    if (other == place) continue;
    const float away_px = std::abs(key_points[other].x_px - key_points[place].x_px) +
                          std::abs(key_points[other].y_px - key_points[place].y_px);
    if (!(away_px < distance_px.back())) continue;
    std::size_t rank = Neighbours::kMost - 1;
    for (; rank > 0 && away_px < distance_px[rank - 1]; --rank) {
      distance_px[rank] = distance_px[rank - 1];
      nearest.index[rank] = nearest.index[rank - 1];
    }
    distance_px[rank] = away_px;
    nearest.index[rank] = static_cast<std::uint16_t>(other);
  }
  return nearest;
}

float between_rad(float a_rad, float b_rad) {
  const float apart_rad = std::abs(a_rad - b_rad);
  return std::min(apart_rad, 2.0F * std::numbers::pi_v<float> - apart_rad);
}

/// Uses doubles: the last bits of atan2 for floats differ between arm64 and x86.
float angle_rad(float x, float y) {
  return static_cast<float>(std::atan2(static_cast<double>(y), static_cast<double>(x)));
}

constexpr float kDegree = 3.14159265F / 180.0F;

KeyPoint ours(const cv::KeyPoint& theirs) {
  return {.x_px = theirs.pt.x,
          .y_px = theirs.pt.y,
          .sigma_px = 0.5F * theirs.size,
          .response = theirs.response,
          .angle_rad = theirs.angle * kDegree,
          .octave = theirs.octave};  // Packed in OpenCV's own format
}

cv::KeyPoint theirs(const KeyPoint& ours) {
  return {ours.x_px, ours.y_px, 2.0F * ours.sigma_px, ours.angle_rad / kDegree, ours.response, ours.octave};
}

/// OpenCV's unmodified SIFT: it doubles the image first and takes frames from the dominant gradients. Settings that
/// exist in OpenCV are passed on. Allocates for every image, and OpenCV may use threads of its own.
class OpenCvSift final : public FeatureFinder {
 public:
  // OpenCV divides the contrast by the number of scales.
  explicit OpenCvSift(const SiftSettings& settings)
      : sift_(cv::SIFT::create(0, settings.scales_per_octave, settings.contrast * settings.scales_per_octave,
                               settings.curvature_ratio, settings.first_sigma_px)),
        clearance_sigmas_(static_cast<float>(settings.clearance_sigmas)) {}

  void detect(const Plane<std::uint16_t>& image, const VisibleRegion& region, std::vector<KeyPoint>& out) override {
    copy(image);
    sift_->detect(image_, found_);
    out.clear();
    for (const cv::KeyPoint& found : found_) {
      const KeyPoint point = ours(found);
      const float clearance_px = region.clearance_px(point.x_px, point.y_px);
      if (clearance_px >= std::max(1.0F, clearance_sigmas_ * point.sigma_px)) out.push_back(point);
    }
  }

  void describe(std::vector<KeyPoint>& key_points, std::vector<Descriptor>& out) override {
    found_.clear();
    for (const KeyPoint& point : key_points) found_.push_back(theirs(point));
    if (!found_.empty()) sift_->compute(image_, found_, described_);
    key_points.clear();
    out.clear();
    for (std::size_t i = 0; i < found_.size(); ++i) {
      key_points.push_back(ours(found_[i]));
      const float* const values = described_.ptr<float>(static_cast<int>(i));
      std::ranges::transform(std::span(values, 128), out.emplace_back().values.begin(),
                             [](float value) { return static_cast<std::uint8_t>(value); });
    }
  }

 private:
  void copy(const Plane<std::uint16_t>& image) {
    image_.create(image.height(), image.width(), CV_8UC1);
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        image_.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>((image.at(x, y) + 128) >> 8);
  }

  cv::Ptr<cv::SIFT> sift_;
  float clearance_sigmas_;
  cv::Mat image_, described_;
  std::vector<cv::KeyPoint> found_;
};

std::unique_ptr<FeatureFinder> make_finder(const SiftSettings& settings) {
  if (settings.detector == SiftDetector::opencv) return std::make_unique<OpenCvSift>(settings);
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

FeatureSelection::FeatureSelection(const SiftSettings& settings, double centre_px)
    : target_count_(as_size(std::max(0, settings.target_count))),
      share_(std::max<std::size_t>(1, target_count_ / as_size(std::max(1, settings.sectors)))),
      half_sector_rad_(std::numbers::pi_v<float> / static_cast<float>(std::max(1, settings.sectors))),
      centre_px_(static_cast<float>(centre_px)) {}

void FeatureSelection::order(const std::vector<KeyPoint>& key_points) {
  candidates_.clear();
  for (const KeyPoint& point : key_points)
    candidates_.push_back({point, angle_rad(point.x_px - centre_px_, point.y_px - centre_px_)});
  std::ranges::sort(candidates_, stronger, &Candidate::point);
}

bool FeatureSelection::has_room(const Candidate& candidate) const {
  std::size_t chosen_near = 0;
  for (const Candidate& other : chosen_) {
    if (between_rad(candidate.azimuth_rad, other.azimuth_rad) <= half_sector_rad_) ++chosen_near;
    if (chosen_near == share_) return false;
  }
  return true;
}

void FeatureSelection::select(std::vector<KeyPoint>& key_points) {
  order(key_points);
  chosen_.clear();
  left_over_.clear();
  for (const Candidate& candidate : candidates_) {
    if (target_count_ == 0 || has_room(candidate)) {
      chosen_.push_back(candidate);
    } else {
      left_over_.push_back(candidate);
    }
    if (chosen_.size() == target_count_ && target_count_ > 0) break;
  }
  for (const Candidate& candidate : left_over_) {
    if (chosen_.size() == target_count_) break;
    chosen_.push_back(candidate);
  }
  std::ranges::sort(chosen_, stronger, &Candidate::point);
  key_points.clear();
  for (const Candidate& candidate : chosen_) key_points.push_back(candidate.point);
}

void find_neighbours(std::span<const KeyPoint> key_points, std::vector<Neighbours>& out) {
  out.clear();
  for (std::size_t i = 0; i < key_points.size(); ++i) out.push_back(nearest_to(i, key_points));
}

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
