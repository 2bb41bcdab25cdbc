#include "tools/replay/replay_record.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <sys/resource.h>
#include <unistd.h>

#include "settings/sample_sentence.hpp"
#include "slam/estimator/estimate_digest.hpp"

namespace azimuth {
namespace {

constexpr std::array kFrontEnds{FrontEnd::bearings, FrontEnd::colour, FrontEnd::sift, FrontEnd::lamps};

ImagesReport images_report(const ImageOutcome& outcome) {
  ImagesReport report{.images = outcome.images, .unreadable = 0, .of_no_use = 0};
  if (outcome.images == 0) return report;
  for (const auto& [trouble, count] : outcome.troubles)
    (trouble == ImageTrouble::unreadable ? report.unreadable : report.of_no_use) += count;
  return report;
}

/// Distance driven at each reading. The first reading after a restart of odometry adds no distance.
std::vector<DrivenBy> driven(const std::vector<OdometryReading>& readings, double scale) {
  std::vector<DrivenBy> driven;
  driven.reserve(readings.size());
  const OdometryReading* before = nullptr;
  for (const OdometryReading& reading : readings) {
    const bool goes_on = before && before->origin == reading.origin;
    const double step_m =
        goes_on ? scale * (reading.T_odom_body.position() - before->T_odom_body.position()).norm() : 0.0;
    driven.push_back({reading.stamp, (driven.empty() ? 0.0 : driven.back().path_m) + step_m});
    before = &reading;
  }
  return driven;
}

/// Raw odometry poses, continuous over restarts of odometry.
std::vector<StampedPose> joined(const std::vector<OdometryReading>& readings) {
  std::vector<StampedPose> poses;
  poses.reserve(readings.size());
  Pose2 T_odom_begin;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const OdometryReading& reading = readings[i];
    if (i > 0 && reading.origin != readings[i - 1].origin)
      T_odom_begin = poses.back().pose * inverse(reading.T_odom_body);
    poses.push_back({reading.stamp, reading.origin == readings.front().origin ? reading.T_odom_body
                                                                              : T_odom_begin * reading.T_odom_body});
  }
  return poses;
}

/// Text on the unreadable part of the recording. Events on channels of other programs do not count.
std::string incomplete(Skipped skipped) {
  skipped.foreign_events = 0;
  return skipped.text();
}

}  // namespace

ReplayRecord replay_record(const Run& run, const Rig& rig, const std::string& estimator, std::uint64_t seed,
                           const ReplayResult& result) {
  ReplayRecord record;
  record.run = run.name;
  record.estimator = estimator;
  record.front_end = front_end_name(rig.front_end);
  record.seed = seed;
  record.health = to_string(result.last.health);
  record.digest = digest_text(result.digest);
  record.estimates = result.estimates;
  for (const PastPose& past : result.past) record.past.push_back({past.stamp, past.T_map_body, past.covariance, {}});
  record.healths = result.healths;
  record.input_trouble = sentence(result.samples);
  record.incomplete = incomplete(run.skipped);
  record.driven = driven(run.odometry, rig.odometry.scale_distance);
  for (const LandmarkEstimate& landmark : result.last.landmarks)
    record.map.push_back({landmark.identity, landmark.p_map_landmark_m, landmark.z_map_landmark_m,
                          landmark.covariance_m2, std::isfinite(landmark.sigma_z_m) ? landmark.sigma_z_m : 0.0});
  if (result.map) record.settled_landmarks = result.map->landmarks.size();
  record.natural_features = rig.front_end == FrontEnd::sift;
  record.raw_odometry = joined(run.odometry);
  for (const TruthPose& truth : run.truth) record.truth.push_back({truth.stamp, truth.T_world_body});
  for (const TrueLandmark& landmark : run.landmarks)
    record.true_landmarks.push_back({landmark.identity, {landmark.x_m, landmark.y_m}, landmark.z_m});
  const AssociationCounts& counts = result.last.association;
  record.association = {counts.accepted, counts.rejected, counts.created, {}};
  record.sightings = result.sightings;
  record.p_body_camera_m = {rig.camera.position_m[0], rig.camera.position_m[1]};
  record.images = images_report(result.images);
  record.times = result.times;
  record.peak_memory_mb = peak_memory_mb();
  record.resident_memory_mb = resident_memory_mb();
  return record;
}

std::string front_end_name(FrontEnd front_end) {
  switch (front_end) {
    case FrontEnd::bearings:
      return "bearings";
    case FrontEnd::colour:
      return "colour";
    case FrontEnd::sift:
      return "sift";
    case FrontEnd::lamps:
      return "lamps";
  }
  return "?";
}

std::optional<FrontEnd> front_end_named(std::string_view name) {
  for (const FrontEnd front_end : kFrontEnds)
    if (front_end_name(front_end) == name) return front_end;
  return std::nullopt;
}

std::vector<std::string> front_end_names() {
  std::vector<std::string> names;
  for (const FrontEnd front_end : kFrontEnds) names.push_back(front_end_name(front_end));
  return names;
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;
}

double resident_memory_mb() {
  double total_pages = 0.0, resident_pages = 0.0;
  std::ifstream statm("/proc/self/statm");
  if (!(statm >> total_pages >> resident_pages)) return kNotMeasured;
  return resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

}  // namespace azimuth
