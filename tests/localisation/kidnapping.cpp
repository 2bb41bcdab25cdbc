#include "tests/localisation/kidnapping.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {
namespace {

constexpr double kImagePeriod_s = 0.2, kSpeed_m_per_s = 0.5;
constexpr double kWrong_m = 0.5, kWrong_rad = 0.15;
constexpr double kOdometrySigma = 0.02;  // per metre of distance [m] or radian of turn [rad]

bool is_free(const KidnapWorld& world, const Eigen::Vector2d& p) {
  const bool inside = (p.array() > world.low_m.array() + 0.5).all() && (p.array() < world.high_m.array() - 0.5).all();
  return inside && std::ranges::none_of(world.truth, [&](const KnownLandmark& landmark) {
           return !landmark.has_height() && (landmark.p_map_m.head<2>() - p).norm() < 0.4;
         });
}

/// Drives ahead where there is room, otherwise turns.
Pose2 next_step(const KidnapWorld& world, const Pose2& T_map_body, double& turn_rad) {
  const double step_m = kSpeed_m_per_s * kImagePeriod_s;
  const Pose2 ahead = T_map_body * Pose2{8.0 * step_m, 0.0, 0.0};
  if (is_free(world, ahead.position()))
    turn_rad *= 0.5;
  else if (turn_rad == 0.0 || std::abs(turn_rad) < 0.02)
    turn_rad = 0.15;
  const Pose2 step{step_m, 0.0, turn_rad};
  return is_free(world, (T_map_body * step).position()) ? step : Pose2{0.0, 0.0, 0.3};
}

}  // namespace

CameraView KidnapWorld::view() const {
  CameraView view;
  view.height_m = camera_height_m;
  view.max_distance_m = 1.25 * range_m;  // known only roughly
  if (camera_height_m > 0.0) {
    view.min_elevation_rad = 0.5 * kPi - max_zenith_rad;
    view.detection_probability = detection;
  }
  return view;
}

std::vector<KnownLandmark> KidnapWorld::map(RandomDraws& draws) const {
  std::vector<KnownLandmark> known = truth;
  for (KnownLandmark& landmark : known) {
    landmark.p_map_m += map_sigma_m * Eigen::Vector3d(draws.normal(), draws.normal(), draws.normal());
    landmark.covariance_m2 = map_sigma_m * map_sigma_m * Eigen::Matrix3d::Identity();
  }
  return known;
}

std::vector<SeenDirection> KidnapWorld::look(const Pose2& T_map_body, RandomDraws& draws) const {
  std::vector<SeenDirection> seen;
  const bool lamps = camera_height_m > 0.0;
  const auto see = [&](double azimuth_rad, double elevation_rad, const KnownLandmark& looks) {
    SeenDirection direction;
    direction.sigma_rad = lamps ? sigma_rad / std::cos(elevation_rad) : sigma_rad;
    direction.azimuth_rad = wrap(azimuth_rad + draws.normal(direction.sigma_rad));
    if (lamps) {
      direction.elevation_rad = elevation_rad + draws.normal(sigma_rad);
      direction.sigma_elevation_rad = sigma_rad;
    }
    if (names) direction.identity = looks.identity;
    if (kinds) direction.kind = looks.kind;
    seen.push_back(direction);
  };
  for (const KnownLandmark& landmark : truth) {
    const Eigen::Vector3d v = CameraPlace(T_map_body, camera_height_m)(landmark);
    const double flat_m = v.head<2>().norm(), elevation_rad = std::atan2(v.z(), flat_m);
    const bool visible = lamps ? 0.5 * kPi - elevation_rad < max_zenith_rad : flat_m < range_m;
    if (visible && draws.chance(detection)) see(std::atan2(v.y(), v.x()), elevation_rad, landmark);
  }
  while (draws.chance(clutter_per_image / (1.0 + clutter_per_image))) {
    const auto any = static_cast<std::size_t>(draws.integer(0, static_cast<int>(truth.size()) - 1));
    see(draws.uniform(-kPi, kPi), 0.5 * kPi - draws.uniform(0.4, max_zenith_rad), truth[any]);
  }
  return seen;
}

KidnapWorld lamp_hall(RandomDraws& draws, double off_m) {
  KidnapWorld world;
  world.low_m = {6.0, -5.0};
  world.high_m = {30.0, 8.0};
  world.camera_height_m = 1.8;
  world.sigma_rad = 0.008;
  world.detection = 0.85;
  world.clutter_per_image = 0.4;
  for (const double x : {4.5, 13.5, 22.5, 31.5})
    for (const double y : {-5.5, -1.0, 3.5, 8.0}) {
      KnownLandmark lamp;
      lamp.p_map_m = {x + draws.uniform(-off_m, off_m), y + draws.uniform(-off_m, off_m), 6.5};
      world.truth.push_back(lamp);
    }
  return world;
}

KidnapWorld lab(RandomDraws& draws) {
  KidnapWorld world;
  while (world.truth.size() < 24) {
    KnownLandmark thing;
    thing.p_map_m = {draws.uniform(0.0, 14.0), draws.uniform(0.0, 10.0), std::nan("")};
    thing.identity = static_cast<Identity>(world.truth.size());
    thing.kind = static_cast<Kind>(world.truth.size() % 4);
    const bool crowded = std::ranges::any_of(world.truth, [&](const KnownLandmark& other) {
      return (other.p_map_m - thing.p_map_m).head<2>().norm() < 0.8;
    });
    if (!crowded) world.truth.push_back(thing);
  }
  return world;
}

Kidnapping kidnap(const KidnapWorld& world, const RelocalisationSettings& settings, double seconds,
                  RandomDraws& draws) {
  Kidnapping result;
  Relocaliser relocaliser(settings);
  std::vector<KnownLandmark> known = world.map(draws);
  if (!world.names)
    for (KnownLandmark& landmark : known) landmark.identity = kUnknownIdentity;
  if (!world.kinds)
    for (KnownLandmark& landmark : known) landmark.kind = kAnyKind;
  Pose2 T_map_body;
  do {
    T_map_body = {draws.uniform(world.low_m.x(), world.high_m.x()), draws.uniform(world.low_m.y(), world.high_m.y()),
                  draws.uniform(-kPi, kPi)};
  } while (!is_free(world, T_map_body.position()));
  std::optional<PositionPrior> within;
  if (world.reach_m) within = PositionPrior{T_map_body.position(), *world.reach_m};
  relocaliser.start(known, world.view(), within);
  double turn_rad = 0.0;
  for (double t = 0.0; t < seconds && !result.found; t += kImagePeriod_s) {
    relocaliser.update(world.look(T_map_body, draws));
    if (const auto pose = relocaliser.found()) {
      result.error_m = (pose->T_map_body.position() - T_map_body.position()).norm();
      result.error_rad = std::abs(wrap(pose->T_map_body.heading_rad - T_map_body.heading_rad));
      result.found = true;
      result.wrong = result.error_m > kWrong_m || result.error_rad > kWrong_rad;
      result.after_s = t;
    }
    const Pose2 step = next_step(world, T_map_body, turn_rad);
    T_map_body = T_map_body * step;
    const double d = std::hypot(step.x_m, step.y_m), a = std::abs(step.heading_rad);
    Motion motion;
    const double sigma_m = kOdometrySigma * std::sqrt(d), sigma_rad = kOdometrySigma * std::sqrt(d + a);
    motion.T_start_end = {step.x_m + draws.normal(sigma_m), step.y_m + draws.normal(0.2 * sigma_m),
                          step.heading_rad + draws.normal(sigma_rad)};
    motion.covariance.diagonal() << sigma_m * sigma_m, 0.04 * sigma_m * sigma_m, sigma_rad * sigma_rad;
    motion.path_m = d;
    motion.turned_rad = a;
    relocaliser.predict(motion);
  }
  result.ambiguous = relocaliser.is_ambiguous();
  return result;
}

}  // namespace azimuth
