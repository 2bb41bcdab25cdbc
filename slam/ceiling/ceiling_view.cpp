#include "slam/ceiling/ceiling_view.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"
#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {
namespace {

constexpr double kMostDetection = 0.95;
// Farther from the zenith, a ceiling 5 m above the camera is more than 18 m away, and a map initialised there becomes
// overconfident through second-order errors.
constexpr double kUsualMaxZenith_rad = 1.3;
constexpr double kVagueDirection_rad = 0.1;  // A lamp with a more uncertain direction is not counted as missed

double detection_probability_of(const Rig& rig, const LampsInView& settings) {
  const double by_rig = rig.camera.image.detection_probability.value_or(kUsualDetection);
  return std::min(settings.detection_probability > 0.0 ? settings.detection_probability : by_rig, kMostDetection);
}

double max_zenith_of(const Rig& rig, const LampsInView& settings) {
  if (settings.max_zenith_rad > 0.0) return settings.max_zenith_rad;
  return std::min(rig.camera.image.theta_max_rad.value_or(kUsualMaxZenith_rad), kUsualMaxZenith_rad);
}

}  // namespace

void CeilingImage::move(std::size_t from, std::size_t to) {
  seen[to] = seen[from];
  measured[to] = measured[from];
  bearing_of[to] = bearing_of[from];
}

void CeilingImage::shorten(std::size_t size) {
  const auto shorten = [size](auto& list) {
    if (list.size() > size) list.erase(list.begin() + static_cast<std::ptrdiff_t>(size), list.end());
  };
  shorten(seen);
  shorten(measured);
  shorten(bearing_of);
}

CeilingView::CeilingView(const Rig& rig, const LampsInView& settings)
    : directions_(rig),
      inner_margin_(settings.inner_margin),
      max_zenith_rad_(max_zenith_of(rig, settings)),
      detection_probability_(detection_probability_of(rig, settings)),
      log_missed_(std::log(1.0 - detection_probability_)) {}

double CeilingView::solid_angle_sr() const { return 2.0 * kPi * (1.0 - std::cos(max_zenith_rad_)); }

void CeilingView::measure(const BearingSet& bearings, const CameraErrors& camera, CeilingImage& out) const {
  out.clear();
  bool any_elevation = false;
  for (std::size_t i = 0; i < bearings.bearings.size(); ++i) {
    const Bearing& bearing = bearings.bearings[i];
    if (!std::isfinite(bearing.elevation_rad)) continue;
    any_elevation = true;
    if (!(kPi / 2.0 - bearing.elevation_rad <= max_zenith_rad_)) continue;
    const LampSeen seen = directions_.seen(bearing, camera.mean);
    out.seen.push_back(seen);
    out.measured.push_back({seen.direction, bearing.identity});
    out.measured.back().seen.add_variance(seen.covariance_by_camera(camera.covariance).diagonal());
    out.bearing_of.push_back(i);
  }
  out.without_elevation = !any_elevation && !bearings.bearings.empty();
}

bool CeilingView::is_in_view(const PredictedDirection& predicted) const {
  const double m2 = predicted.offset.m.squaredNorm();
  const double variance_rad2 = predicted.covariance.trace() / (1.0 + m2);
  return std::atan(std::sqrt(m2)) < max_zenith_rad_ * (1.0 - inner_margin_) &&
         variance_rad2 < kVagueDirection_rad * kVagueDirection_rad;
}

double CeilingView::detection(const PredictedDirection& predicted) const {
  const bool at_rim = std::atan(predicted.offset.m.norm()) > max_zenith_rad_ * (1.0 - inner_margin_);
  return (at_rim ? 0.5 : 1.0) * (1.0 - std::exp(log_missed_));
}

/// Probability that the lamp is within max_zenith_rad_ of the zenith.
double CeilingView::chance_of_view(const PredictedDirection& predicted) const {
  const double length = predicted.offset.m.norm();
  if (!(length > 0.0)) return 1.0;
  const Eigen::Vector2d outwards = predicted.offset.m / (length * (1.0 + length * length));
  const double variance_rad2 = outwards.dot(predicted.covariance * outwards);
  return 0.5 * complementary_error((std::atan(length) - max_zenith_rad_) / std::sqrt(2.0 * variance_rad2 + 1e-12));
}

}  // namespace azimuth
