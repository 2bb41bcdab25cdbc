// Messages made from samples; messages.cpp decodes them.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>

#include "drivers/wire/messages.hpp"

namespace azimuth {
namespace {

feature_t to_feature(const Bearing& bearing) {
  feature_t feature{};
  feature.azimuth_rad = bearing.azimuth_rad;
  feature.elevation_rad = bearing.elevation_rad;
  feature.identity = bearing.identity;
  feature.kind = bearing.kind;
  feature.sigma_rad = bearing.sigma_rad;
  feature.sigma_elevation_rad = bearing.sigma_elevation_rad;
  feature.radius_px = bearing.radius_px;
  return feature;
}

landmark_t to_message(const TrueLandmark& landmark) {
  landmark_t message{};
  message.id = landmark.identity;
  message.identity = landmark.identity;
  message.x_m = landmark.x_m;
  message.y_m = landmark.y_m;
  message.z_m = landmark.z_m;
  message.sigma_z_m = std::isnan(landmark.z_m) ? landmark.z_m : 0.0;
  return message;
}

}  // namespace

odometry_t to_message(const OdometryReading& reading) {
  odometry_t message{};
  message.utime = to_us(reading.stamp);
  message.seq = static_cast<std::int64_t>(reading.sequence);
  message.origin = static_cast<std::int32_t>(reading.origin);
  message.x_m = reading.T_odom_body.x_m;
  message.y_m = reading.T_odom_body.y_m;
  message.heading_rad = reading.T_odom_body.heading_rad;
  message.sigma_gap_m = reading.sigma_gap_m;
  message.sigma_gap_rad = reading.sigma_gap_rad;
  return message;
}

odometry_t to_message(const TruthPose& truth, std::int64_t sequence) {
  return to_message(OdometryReading{.stamp = truth.stamp,
                                    .sequence = static_cast<std::uint64_t>(sequence),
                                    .origin = 0,
                                    .T_odom_body = truth.T_world_body,
                                    .sigma_gap_m = 0.0,
                                    .sigma_gap_rad = 0.0});
}

bearings_t to_message(const BearingSet& set) {
  bearings_t message{};
  fill_message(set, message);
  return message;
}

void fill_message(const BearingSet& set, bearings_t& message) {
  message.utime = to_us(set.stamp);
  message.utime_mono = 0;
  message.seq = static_cast<std::int64_t>(set.sequence);
  message.n = static_cast<std::int32_t>(set.bearings.size());
  message.bearings.resize(set.bearings.size());
  std::ranges::transform(set.bearings, message.bearings.begin(), [](const Bearing& bearing) {
    bearing_t element{};
    element.azimuth_rad = bearing.azimuth_rad;
    element.elevation_rad = bearing.elevation_rad;
    element.identity = bearing.identity;
    return element;
  });
}

bool is_plain(const BearingSet& set) {
  const auto plain = [](const Bearing& bearing) {
    return bearing.kind == kAnyKind && std::isnan(bearing.sigma_rad) && std::isnan(bearing.radius_px) &&
           std::isnan(bearing.sigma_elevation_rad);
  };
  return set.trouble == ImageTrouble::none && set.descriptors.empty() && set.neighbours.empty() &&
         std::ranges::all_of(set.bearings, plain);
}

features_t to_features_message(const BearingSet& set) {
  features_t message{};
  fill_message(set, message);
  return message;
}

void fill_message(const BearingSet& set, features_t& message) {
  const std::size_t n = set.bearings.size();
  assert(n <= features_t::MAX_FEATURES);
  assert(set.descriptors.empty() || set.descriptors.size() == n);
  assert(set.neighbours.empty() || set.neighbours.size() == n);
  message.utime = to_us(set.stamp);
  message.utime_mono = 0;
  message.seq = static_cast<std::int64_t>(set.sequence);
  message.trouble = static_cast<std::int8_t>(set.trouble);
  message.n = static_cast<std::int32_t>(n);
  message.n_descriptors = static_cast<std::int32_t>(set.descriptors.size());
  message.n_neighbours = static_cast<std::int32_t>(set.neighbours.size());
  message.features.resize(n);
  message.descriptors.resize(set.descriptors.size());
  message.neighbours.resize(set.neighbours.size());
  std::ranges::transform(set.bearings, message.features.begin(), to_feature);
  for (std::size_t i = 0; i < set.descriptors.size(); ++i)
    std::ranges::copy(set.descriptors[i].values, std::begin(message.descriptors[i].values));
  for (std::size_t i = 0; i < set.neighbours.size(); ++i)
    std::ranges::transform(set.neighbours[i].index, std::begin(message.neighbours[i].index),
                           [](std::uint16_t index) { return static_cast<std::int16_t>(index); });
}

document_t to_message(std::string_view name, std::string_view text, Stamp stamp) {
  document_t message{};
  message.utime = to_us(stamp);
  message.name = name;
  message.size = static_cast<std::int32_t>(text.size());
  message.data.assign(text.begin(), text.end());
  return message;
}

std::vector<map_chunk_t> to_messages(std::span<const TrueLandmark> landmarks, Stamp stamp) {
  constexpr auto kMaxLandmarks = static_cast<std::size_t>(map_chunk_t::MAX_LANDMARKS);
  std::vector<map_chunk_t> chunks(std::max<std::size_t>(1, (landmarks.size() + kMaxLandmarks - 1) / kMaxLandmarks));
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    const auto part =
        landmarks.subspan(i * kMaxLandmarks, std::min(kMaxLandmarks, landmarks.size() - i * kMaxLandmarks));
    map_chunk_t& chunk = chunks[i];
    chunk.utime = to_us(stamp);
    chunk.utime_mono = chunk.seq = 0;
    chunk.chunk = static_cast<std::int32_t>(i);
    chunk.chunks = static_cast<std::int32_t>(chunks.size());
    chunk.n = static_cast<std::int32_t>(part.size());
    for (const TrueLandmark& landmark : part) chunk.landmarks.push_back(to_message(landmark));
  }
  return chunks;
}

}  // namespace azimuth
