#include "daemon/publish/messages.hpp"

#include <algorithm>
#include <cmath>

#include "drivers/estimates/estimate_messages.hpp"
#include "settings/sample_sentence.hpp"
#include "slam/estimator/innovations.hpp"

namespace azimuth {
namespace {

/// LCM has no unsigned integer types.
constexpr std::int64_t count(std::uint64_t value) { return static_cast<std::int64_t>(value); }

/// Number of pieces for `things` elements, `in_one` in each piece; at least one piece.
std::int32_t pieces(std::size_t things, std::size_t in_one) {
  return static_cast<std::int32_t>(std::max<std::size_t>(1, (things + in_one - 1) / in_one));
}

template <class T>
std::span<const T> piece_of(std::span<const T> things, std::int32_t piece, std::size_t in_one) {
  const std::size_t first = std::min(things.size(), static_cast<std::size_t>(piece) * in_one);
  return things.subspan(first, std::min(in_one, things.size() - first));
}

expected_bearing_t to_message(const ExpectedBearing& expected) {
  expected_bearing_t message{};
  message.landmark_id = expected.landmark;
  message.azimuth_rad = expected.azimuth_rad;
  message.sigma_rad = expected.sigma_rad;
  message.gate_rad = expected.gate_rad;
  message.elevation_rad = expected.elevation_rad;
  message.gate_elevation_rad = expected.gate_elevation_rad;
  message.rejected_in_row = expected.rejected_in_row;
  return message;
}

/// Moves the expected bearings that were used before all others.
void put_used_first(StepResult& step) {
  std::vector<ExpectedBearing>& bearings = step.expected.bearings;
  std::partition(bearings.begin(), bearings.end(), [&](const ExpectedBearing& each) {
    return std::ranges::count(step.estimate.accepted, each.landmark, &AcceptedSighting::landmark_id) > 0;
  });
}

}  // namespace

pose_t bot_pose_message(const Estimate& estimate) {
  pose_t message{};
  message.utime = to_us(estimate.stamp);
  message.pos[0] = estimate.T_map_body.x_m;
  message.pos[1] = estimate.T_map_body.y_m;
  message.orientation[0] = std::cos(0.5 * estimate.T_map_body.heading_rad);
  message.orientation[3] = std::sin(0.5 * estimate.T_map_body.heading_rad);
  return message;
}

std::int32_t map_chunks(std::size_t landmarks) { return pieces(landmarks, map_chunk_t::MAX_LANDMARKS); }

void fill_map_chunk(std::span<const LandmarkEstimate> landmarks, Stamp stamp, std::uint64_t sequence,
                    std::int32_t chunk, map_chunk_t& message) {
  const auto piece = piece_of(landmarks, chunk, map_chunk_t::MAX_LANDMARKS);
  message.utime = to_us(stamp);
  message.utime_mono = 0;
  message.seq = count(sequence);
  message.chunk = chunk;
  message.chunks = map_chunks(landmarks.size());
  message.n = static_cast<std::int32_t>(piece.size());
  message.landmarks.resize(piece.size());
  std::transform(piece.begin(), piece.end(), message.landmarks.begin(),
                 [](const LandmarkEstimate& landmark) { return to_message(landmark); });
}

std::int32_t path_chunks(std::size_t poses) { return pieces(poses, path_t::MAX_POSES); }

void fill_path_chunk(std::span<const PathPose> path, std::uint64_t sequence, std::int32_t chunk, path_t& message) {
  const auto piece = piece_of(path, chunk, path_t::MAX_POSES);
  message.utime = path.empty() ? 0 : to_us(path.back().stamp);
  message.utime_mono = 0;
  message.seq = count(sequence);
  message.chunk = chunk;
  message.chunks = path_chunks(path.size());
  message.n = static_cast<std::int32_t>(piece.size());
  message.poses.resize(piece.size());
  std::transform(piece.begin(), piece.end(), message.poses.begin(),
                 [](const PathPose& pose) { return to_message(pose); });
}

void fill_message(const Estimate& step, sightings_t& message) {
  const std::size_t n = std::min<std::size_t>(step.accepted.size(), sightings_t::MAX_SIGHTINGS);
  message.utime = to_us(step.stamp);
  message.utime_mono = 0;
  message.step = count(step.step);
  message.accepted = count(step.association.accepted);
  message.rejected = count(step.association.rejected);
  message.ambiguous = count(step.association.ambiguous);
  message.thinned = count(step.association.thinned);
  message.created = count(step.association.created);
  message.n = static_cast<std::int32_t>(n);
  message.sightings.resize(n);
  std::transform(step.accepted.begin(), step.accepted.begin() + static_cast<std::ptrdiff_t>(n),
                 message.sightings.begin(), [](const AcceptedSighting& sighting) {
                   sighting_t element{};
                   element.landmark_id = sighting.landmark_id;
                   element.azimuth_rad = sighting.azimuth_rad;
                   element.elevation_rad = sighting.elevation_rad;
                   element.sigma_rad = sighting.sigma_rad;
                   return element;
                 });
}

void fill_message(StepResult& step, expectations_t& message) {
  std::vector<ExpectedBearing>& bearings = step.expected.bearings;
  std::ranges::sort(bearings, {}, &ExpectedBearing::landmark);
  const Innovations innovations = innovations_of(bearings, step.estimate.accepted);
  if (bearings.size() > expectations_t::MAX_EXPECTED) put_used_first(step);
  const std::size_t n = std::min<std::size_t>(bearings.size(), expectations_t::MAX_EXPECTED);
  message.utime = to_us(step.estimate.stamp);
  message.utime_mono = 0;
  message.step = count(step.estimate.step);
  message.nis = innovations.nis;
  message.compared = static_cast<std::int32_t>(innovations.compared);
  message.n = static_cast<std::int32_t>(n);
  message.expected.resize(n);
  std::transform(bearings.begin(), bearings.begin() + static_cast<std::ptrdiff_t>(n), message.expected.begin(),
                 [](const ExpectedBearing& each) { return to_message(each); });
}

kept_t kept_message(const Status& status) {
  const RecordStatus& log = status.record;
  kept_t message{};
  message.utime = to_us(status.estimate.stamp);
  message.log_size = log.text.empty() ? -1 : count(log.kept_bytes);
  message.log_quota = count(log.quota_bytes);
  message.disk_free = log.free_mb ? count(*log.free_mb * 1'000'000) : -1;
  message.map_utime = status.map.written_us;
  return message;
}

status_t status_message(const Status& status) {
  const Estimate& estimate = status.estimate;
  status_t message{};
  message.utime = to_us(estimate.stamp);
  const ToldHealth told = told_health(estimate, status.odometer, status.camera);
  message.health = health_code(told.health);
  message.reason = told.reason;
  message.estimates = count(status.published);
  message.steps = count(estimate.step);
  message.estimate_digest = count(status.digest);
  message.landmarks = static_cast<std::int32_t>(status.landmarks);

  message.accepted = count(estimate.association.accepted);
  message.rejected = count(estimate.association.rejected);
  message.thinned = count(estimate.association.thinned);
  message.created = count(estimate.association.created);
  message.deleted = count(estimate.association.deleted);
  message.recovered = count(estimate.association.recovered);

  message.odometry_out_of_order = count(estimate.input.odometry_out_of_order);
  message.bearings_out_of_order = count(estimate.input.bearings_out_of_order);
  message.bearings_without_odometry = count(estimate.input.bearings_without_odometry);
  message.values_not_finite = count(estimate.input.values_not_finite);
  message.odometry_gaps = count(estimate.input.odometry_gaps);
  message.bearing_gaps = count(estimate.input.bearing_gaps);

  message.odometry_refused = count(status.wires.odometry_refused);
  message.bearings_refused = count(status.wires.bearings_refused);
  message.frames_replaced = count(status.wires.frames_replaced);
  message.estimates_replaced = count(status.wires.estimates_replaced);
  message.echoes_refused = count(status.wires.echoes_refused);
  message.publish_failures = count(status.publish_failures);

  message.frames = count(status.perception.frames);
  message.frames_unusable = count(status.perception.frames_unusable);
  message.image_trouble = to_string(status.perception.trouble);
  message.detect_mean_us = status.perception.detect_mean_us;
  message.detect_max_us = status.perception.detect_max_us;

  message.input_trouble = sentence(status.samples);
  if (message.input_trouble.empty()) message.input_trouble = status.pace;
  message.map_trouble = status.map.trouble ? status.map.text : "";
  message.picture_trouble = status.picture;

  message.odometer = status.odometer.text;
  message.camera = status.camera.text;
  message.recorder = status.record.text;
  if (!status.frame_record.text.empty()) message.recorder += "; images: " + status.frame_record.text;
  message.realtime = status.process.realtime;
  message.configuration = status.process.configuration;
  message.odometer_reconnects = count(status.odometer.reconnects);
  message.camera_reconnects = count(status.camera.reconnects);
  message.odometer_resets = count(status.odometer.port_resets);
  message.camera_resets = count(status.camera.port_resets);
  message.camera_missing = count(status.camera.images_missing);
  message.camera_corrupt = count(status.camera.images_corrupt);
  message.record_losses = count(status.record.losses + status.frame_record.losses + status.wires.records_refused);
  message.battery_v = status.odometer.battery_v;
  message.robot_flags = static_cast<std::int32_t>(status.odometer.robot_flags);
  return message;
}

}  // namespace azimuth
