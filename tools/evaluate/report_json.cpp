#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/evaluate/report.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has neither NaN nor infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json optional_text(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json position_errors(const ErrorStatistics& errors) {
  return {{"rmse_m", number(errors.rmse)},
          {"mean_m", number(errors.mean)},
          {"max_m", number(errors.max)},
          {"final_m", number(errors.final)}};
}

Json pose(const Report& report) {
  Json json = position_errors(report.position_m);
  json["heading_rmse_rad"] = number(report.heading_rad.rmse);
  json["heading_max_rad"] = number(report.heading_rad.max);
  const Eigen::Vector3d& two_sigma = report.two_sigma_final;
  json["two_sigma_final"] = {number(two_sigma.x()), number(two_sigma.y()), number(two_sigma.z())};
  json["anees"] = number(report.consistency.anees);
  json["evaluated"] = report.position_m.count;
  json["without_truth"] = report.steps - report.position_m.count;
  json["anees_evaluated"] = report.consistency.evaluated;
  json["anees_singular"] = report.consistency.singular;
  json["anees_tracking"] = number(report.tracking_consistency.anees);
  return json;
}

/// All values are null if the sensor gives no identities.
Json named_map(const NamedMapError& map) {
  const bool measured = map.named > 0;
  return {{"matched", measured ? Json(map.named) : Json(nullptr)},
          {"mean_m", number(map.position_m.mean)},
          {"rmse_m", number(map.position_m.rmse)},
          {"max_m", number(map.position_m.max)},
          {"duplicates", measured ? Json(map.duplicates) : Json(nullptr)}};
}

/// All values are null if the map or the truth has no heights.
Json space_map(const SpaceMapError& map) {
  const bool measured = map.landmarks > 0 && map.true_landmarks > 0;
  return {{"matched", measured ? Json(map.matched) : Json(nullptr)},
          {"mean_m", number(map.position_m.mean)},
          {"rmse_m", number(map.position_m.rmse)},
          {"max_m", number(map.position_m.max)},
          {"duplicates", measured ? Json(map.duplicates) : Json(nullptr)},
          {"phantoms", measured ? Json(map.phantoms) : Json(nullptr)},
          {"height_mean_m", number(map.height_mean_m)}};
}

Json map(const Report& report) {
  const MapError& error = report.map;
  const bool compared = report.T_world_map && error.true_landmarks > 0 && !report.natural_features;
  return {{"landmarks", error.landmarks},
          {"settled", report.settled_landmarks ? Json(*report.settled_landmarks) : Json(nullptr)},
          {"matched", compared ? Json(error.matched) : Json(nullptr)},
          {"mean_m", number(error.position_m.mean)},
          {"rmse_m", number(error.position_m.rmse)},
          {"max_m", number(error.position_m.max)},
          {"duplicates", compared ? Json(error.duplicates) : Json(nullptr)},
          {"phantoms", compared ? Json(error.phantoms) : Json(nullptr)},
          {"true_landmarks", error.true_landmarks},
          {"pair_distance_rms_m", number(error.pair_distance_rms_m)},
          {"by_identity", named_map(report.named_map)},
          {"in_space", space_map(report.space_map)}};
}

/// Null if the estimator does not revise past poses.
Json hindsight(const Report& report) {
  if (!report.hindsight) return nullptr;
  const HindsightReport& hindsight = *report.hindsight;
  Json json = position_errors(hindsight.position_m);
  json["heading_rmse_rad"] = number(hindsight.heading_rad.rmse);
  json["anees"] = number(hindsight.consistency.anees);
  json["map"] = {{"landmarks", hindsight.map.landmarks},
                 {"matched", hindsight.map.matched},
                 {"rmse_m", number(hindsight.map.position_m.rmse)},
                 {"max_m", number(hindsight.map.position_m.max)},
                 {"duplicates", hindsight.map.duplicates},
                 {"phantoms", hindsight.map.phantoms},
                 {"pair_distance_rms_m", number(hindsight.map.pair_distance_rms_m)}};
  return json;
}

Json association(const AssociationReport& association) {
  const SightingErrors& sightings = association.sightings;
  return {{"accepted", association.accepted},
          {"rejected", association.rejected},
          {"new", association.created},
          {"wrong", sightings.judged > 0 ? Json(sightings.wrong) : Json(nullptr)},
          {"judged", sightings.judged}};
}

/// Null if the run contains bearings instead of images.
Json images(const ImagesReport& images) {
  if (images.images == 0) return nullptr;
  return {{"images", images.images}, {"unreadable", images.unreadable}, {"of_no_use", images.of_no_use}};
}

Json health_time(const HealthTime& time) {
  return {{"s", number(time.seconds)},
          {"share", number(time.share)},
          {"first_reason", optional_text(time.first_reason)},
          {"first_reason_at_s", number(time.first_reason_at_s)}};
}

/// Null if no step has a health.
Json health_over_time(const HealthReport& report) {
  if (!std::isfinite(report.blind.longest_s)) return nullptr;
  Json json;
  for (const Health health : kHealths) json[std::string(to_string(health))] = health_time(report.of(health));
  json["times_lost"] = report.times_lost;
  json["times_found"] = report.times_found;
  const BlindReport& blind = report.blind;
  json["blind"] = {{"driven_m", number(blind.driven_m)},
                   {"path_m", number(blind.path_m)},
                   {"gaps", blind.gaps},
                   {"longest_s", number(blind.longest_s)}};
  return json;
}

Json times(const TimeStatistics& times) {
  return {{"median", number(times.median_us)},
          {"p99", number(times.p99_us)},
          {"max", number(times.max_us)},
          {"mean", number(times.mean_us)}};
}

}  // namespace

std::string to_json(const Report& report) {
  Json json;
  json["name"] = optional_text(report.label.name);
  json["tags"] = report.label.tags;
  json["overrides"] = report.label.overrides;
  json["made_by"] = optional_text(report.label.made_by);
  json["run"] = report.run;
  json["estimator"] = report.estimator;
  json["front_end"] = report.front_end;
  json["seed"] = report.seed;
  json["steps"] = report.steps;
  json["pose"] = pose(report);
  json["hindsight"] = hindsight(report);
  json["odometry_only"] = position_errors(report.odometry_m);
  json["odometry_raw"] = position_errors(report.odometry_raw_m);
  json["map"] = map(report);
  json["association"] = association(report.association);
  json["images"] = images(report.images);
  json["time_us"] = {{"detect", times(report.detect)},
                     {"update", times(report.update)},
                     {"step", times(report.step)},
                     {"decode", times(report.decode)},
                     {"image_period", number(report.image_period_us)}};
  json["peak_memory_mb"] = number(report.peak_memory_mb);
  json["resident_memory_mb"] = number(report.resident_memory_mb);
  json["health"] = optional_text(report.health);
  json["health_over_time"] = health_over_time(report.health_over_time);
  json["input_trouble"] = optional_text(report.input_trouble);
  json["incomplete"] = optional_text(report.incomplete);
  json["digest"] = optional_text(report.digest);
  // The run's name is the name of its folder, which need not be valid UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace azimuth
