// LampEkfEstimator: its output.

#include <algorithm>
#include <cmath>

#include "slam/ceiling/lamp_ekf_estimator.hpp"
#include "slam/ceiling/make_lamp_ekf_estimator.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kAtTheZenith = 1e-6;  // In metres per metre of height: nearer to the zenith the azimuth is undefined.
constexpr double kViewsDiffer = 0.5;   // Driven distance per metre of the lamps' height above the camera

/// Rows: d azimuth / dm and d zenith angle / dm.
Eigen::Matrix2d angles_by_offset(const Eigen::Vector2d& m) {
  const double m2 = m.squaredNorm(), length = std::sqrt(m2);
  return Eigen::Matrix2d{{-m.y() / m2, m.x() / m2}, {m.x() / (length * (1.0 + m2)), m.y() / (length * (1.0 + m2))}};
}

}  // namespace

std::optional<std::string_view> why_unfit_for_lamp_ekf(const MapSnapshot& map, const Rig& rig) {
  if (!std::ranges::all_of(map.landmarks, &MapLandmark::has_height))
    return "its landmarks have no heights, and estimator \"lamp_ekf\" maps in space";
  return why_names_do_not_fit(map, rig);
}

void LampEkfEstimator::estimate(Estimate& out) const {
  write_robot(out);
  for (const Lamp& lamp : lamps()) {
    if (!lamp.confirmed) continue;
    LampPoint point = ekf_.point(lamp.at);
    point.covariance_m2 += ekf_.covariance_by_considered(lamp.at);
    LandmarkEstimate& entry = out.landmarks.emplace_back();
    entry.id = lamp.id;
    entry.identity = lamp.identity;
    entry.p_map_landmark_m = point.p_map_lamp_m.head<2>();
    entry.covariance_m2 = point.covariance_m2.topLeftCorner<2, 2>();
    entry.z_map_landmark_m = point.p_map_lamp_m.z();
    entry.sigma_z_m = std::sqrt(point.covariance_m2(2, 2));
  }
}

std::optional<UsualHeight> LampEkfEstimator::usual_height() const { return map_.usual_height(ekf_); }

bool LampEkfEstimator::views_differ() const {
  const std::optional<UsualHeight> height = usual_height();
  return height && recognition_.path_m >= kViewsDiffer * height->mean_m;
}

Judgement LampEkfEstimator::judged_with_map(Evidence heard) const {
  heard.landmarks = map_.confirmed();
  heard.max_landmarks = as_size(settings_.max_landmarks);
  Judgement judgement = judge(heard, health_);
  if (judgement.health == Health::starting) judgement.reason = why_starting(judgement.reason);
  return judgement;
}

std::string_view LampEkfEstimator::why_starting(std::string_view usual) const {
  if (image_.crowded) return "too many lights to begin a map with";
  if (!map_.empty() && !map_.any_proven()) return "no landmark is known to be a lamp and not a reflection";
  if (image_.without_elevation) return "bearings bring no elevation";
  return usual;
}

/// Lists every lamp above the camera. The gates of both angles bound the ellipse of directions that are matched with
/// it.
void LampEkfEstimator::expect(std::vector<ExpectedBearing>& out) const {
  out.clear();
  for (const Lamp& lamp : lamps()) {
    const auto predicted = ekf_.predict(lamp.at);
    if (!predicted || !(predicted->m.norm() > kAtTheZenith)) continue;
    const Eigen::Vector2d& m = predicted->m;
    const Direction direction{std::atan2(m.y(), m.x()), kPi / 2.0 - std::atan(m.norm())};
    const Direction shown = view_.directions().shown(direction, camera_or_exact().mean);
    const Eigen::Matrix2d by_m = angles_by_offset(m);
    const Eigen::Matrix2d S =
        by_m * ekf_.covariance(*predicted, *predicted) * by_m.transpose() +
        view_.directions().covariance({.azimuth_rad = shown.azimuth_rad, .elevation_rad = shown.elevation_rad});
    out.push_back({.landmark = lamp.id,
                   .azimuth_rad = shown.azimuth_rad,
                   .gate_rad = std::sqrt(settings_.gates.chi2 * S(0, 0)),
                   .elevation_rad = shown.elevation_rad,
                   .gate_elevation_rad = std::sqrt(settings_.gates.chi2 * S(1, 1)),
                   .sigma_rad = std::sqrt(S(0, 0))});
  }
}

void LampEkfEstimator::list_saved(StateSaver& saver) const {
  for (const Lamp& lamp : lamps())
    if (lamp.confirmed && lamp.at.kind == BlockKind::point3)
      saver.add(lamp.at.block, lamp.at.kind, {.id = lamp.id, .identity = lamp.identity, .sightings = lamp.sightings});
}

}  // namespace azimuth
