#include "drivers/wire/messages.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>

#include "drivers/wire/plausible.hpp"

namespace azimuth {

namespace {

constexpr std::size_t kFingerprintSize = 8;
constexpr std::size_t kPreambleSize = kFingerprintSize + 3 * 8;  // with utime, utime_mono and seq

std::uint32_t uint32_at(Bytes data, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = (word << 8U) | std::to_integer<std::uint32_t>(data[at + i]);
  return word;
}

template <class Message>
bool has_fingerprint(Bytes data) {
  const auto fingerprint = (std::uint64_t{uint32_at(data, 0)} << 32U) | uint32_at(data, 4);
  return fingerprint == static_cast<std::uint64_t>(Message::getHash());
}

/// Encoded size of a message with empty arrays and texts, or of an element with a fingerprint.
template <class Message>
std::size_t empty_size() {
  return static_cast<std::size_t>(Message{}.getEncodedSize());
}

/// Decodes bytes whose lengths and counts have been checked to match a message of exactly this size.
template <class Message>
std::optional<Message> decode_checked(Bytes data) {
  constexpr auto kMaxSize = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (data.size() > kMaxSize || !has_fingerprint<Message>(data)) return std::nullopt;
  Message message{};
  const int size = static_cast<int>(data.size());
  if (message.decode(data.data(), 0, size) != size) return std::nullopt;
  if (!is_plausible_stamp(message.utime)) return std::nullopt;
  return message;
}

/// Decodes a message that ends with `int32_t n; Element elements[n]`.
template <class Message, class Element>
std::optional<Message> decode_array(Bytes data) {
  const std::size_t size_without = empty_size<Message>();
  const std::size_t element_size = empty_size<Element>() - kFingerprintSize;
  if (data.size() < size_without) return std::nullopt;
  const std::size_t count = uint32_at(data, size_without - 4);
  const std::size_t room = data.size() - size_without;
  if (room % element_size != 0 || count != room / element_size) return std::nullopt;
  return decode_checked<Message>(data);
}

/// True: the counts in a features_t match its size.
bool counts_fit(Bytes data, std::size_t size_without) {
  const std::int64_t n = uint32_at(data, size_without - 12), descriptors = uint32_at(data, size_without - 8),
                     neighbours = uint32_at(data, size_without - 4);
  if (n > features_t::MAX_FEATURES || (descriptors != 0 && descriptors != n) || (neighbours != 0 && neighbours != n))
    return false;
  const auto bytes_of = [](std::int64_t count, std::size_t size_alone) {
    return static_cast<std::size_t>(count) * (size_alone - kFingerprintSize);
  };
  return data.size() == size_without + bytes_of(n, empty_size<feature_t>()) +
                            bytes_of(descriptors, empty_size<descriptor_t>()) +
                            bytes_of(neighbours, empty_size<neighbours_t>());
}

Bearing to_bearing(const feature_t& feature) {
  return {.azimuth_rad = feature.azimuth_rad,
          .elevation_rad = feature.elevation_rad,
          .identity = feature.identity,
          .kind = feature.kind,
          .sigma_rad = feature.sigma_rad,
          .radius_px = feature.radius_px,
          .sigma_elevation_rad = feature.sigma_elevation_rad};
}

/// False: a value is implausible.
bool append_bearing(Bearing bearing, BearingSet& set) {
  if (!is_plausible(bearing)) return false;
  if (is_plausible_azimuth(bearing.azimuth_rad)) bearing.azimuth_rad = wrap(bearing.azimuth_rad);
  set.bearings.push_back(bearing);
  return true;
}

/// False: a neighbour is not in the set.
bool append_neighbours(const neighbours_t& message, std::size_t count, BearingSet& set) {
  Neighbours neighbours;
  for (std::size_t i = 0; i < Neighbours::kMost; ++i) {
    neighbours.index[i] = static_cast<std::uint16_t>(message.index[i]);
    if (neighbours.index[i] != Neighbours::kNone && neighbours.index[i] >= count) return false;
  }
  set.neighbours.push_back(neighbours);
  return true;
}

/// Number of bytes before the first text of a status_t, between each two texts, and after the last.
constexpr std::array<std::size_t, 11> kBetweenTexts{33, 188, 16, 0, 0, 0, 0, 0, 56, 0, 12};

/// True: the only NUL is at the end. A text with another NUL would be encoded shorter than it was decoded.
bool is_text(Bytes text) { return !text.empty() && std::ranges::find(text, std::byte{0}) == text.end() - 1; }

/// True: each text, preceded by its length including the closing NUL, lies within the bytes, and the message ends at
/// the right place.
bool texts_fit(Bytes data) {
  std::size_t at = 0;
  for (std::size_t i = 0; i + 1 < kBetweenTexts.size(); ++i) {
    at += kBetweenTexts[i];
    if (at > data.size() || data.size() - at < 4) return false;
    const std::size_t length = uint32_at(data, at);
    at += 4;
    if (length > data.size() - at || !is_text(data.subspan(at, length))) return false;
    at += length;
  }
  return data.size() - at == kBetweenTexts.back();
}

/// True: the number of the piece is within the number of pieces.
template <class Chunk>
bool is_a_piece(const Chunk& chunk) {
  return chunk.chunk >= 0 && chunk.chunk < chunk.chunks;
}

bool is_plausible_pose(const path_pose_t& pose) {
  return is_plausible_stamp(pose.utime) && is_plausible(Pose2{pose.x_m, pose.y_m, pose.heading_rad});
}

bool is_plausible(const landmark_t& landmark) {
  const bool flat = std::isnan(landmark.z_m);
  return is_plausible_coordinate(landmark.x_m) && is_plausible_coordinate(landmark.y_m) &&
         (flat || is_plausible_coordinate(landmark.z_m)) &&
         std::ranges::all_of(landmark.covariance, [](double value) { return std::isfinite(value); });
}

}  // namespace

std::optional<OdometryReading> decode_odometry(Bytes data) {
  if (data.size() != empty_size<odometry_t>()) return std::nullopt;
  const std::optional<odometry_t> message = decode_checked<odometry_t>(data);
  if (!message) return std::nullopt;
  const Pose2 pose{message->x_m, message->y_m, message->heading_rad};
  if (!is_plausible(pose) || !is_plausible_sigma(message->sigma_gap_m) || !is_plausible_sigma(message->sigma_gap_rad))
    return std::nullopt;
  return OdometryReading{.stamp = stamp_from_us(message->utime),
                         .sequence = static_cast<std::uint64_t>(message->seq),
                         .origin = static_cast<std::uint32_t>(message->origin),
                         .T_odom_body = {pose.x_m, pose.y_m, wrap(pose.heading_rad)},
                         .sigma_gap_m = message->sigma_gap_m,
                         .sigma_gap_rad = message->sigma_gap_rad};
}

std::optional<TruthPose> decode_truth(Bytes data) {
  const std::optional<OdometryReading> pose = decode_odometry(data);
  if (!pose) return std::nullopt;
  return TruthPose{.stamp = pose->stamp, .T_world_body = pose->T_odom_body};
}

std::optional<BearingSet> decode_bearings(Bytes data) {
  const std::optional<bearings_t> message = decode_array<bearings_t, bearing_t>(data);
  if (!message) return std::nullopt;
  BearingSet set{
      .stamp = stamp_from_us(message->utime), .sequence = static_cast<std::uint64_t>(message->seq), .bearings = {}};
  set.bearings.reserve(message->bearings.size());
  for (const bearing_t& element : message->bearings) {
    if (!append_bearing({element.azimuth_rad, element.elevation_rad, element.identity}, set)) return std::nullopt;
  }
  return set;
}

std::optional<BearingSet> decode_features(Bytes data) {
  const std::size_t size_without = empty_size<features_t>();
  if (data.size() < size_without || !counts_fit(data, size_without)) return std::nullopt;
  const std::optional<features_t> message = decode_checked<features_t>(data);
  if (!message || message->trouble < 0 || message->trouble >= kImageTroubles) return std::nullopt;
  BearingSet set{
      .stamp = stamp_from_us(message->utime), .sequence = static_cast<std::uint64_t>(message->seq), .bearings = {}};
  set.trouble = static_cast<ImageTrouble>(message->trouble);
  set.bearings.reserve(message->features.size());
  for (const feature_t& feature : message->features)
    if (!append_bearing(to_bearing(feature), set)) return std::nullopt;
  for (const descriptor_t& descriptor : message->descriptors)
    std::ranges::copy(descriptor.values, set.descriptors.emplace_back().values.begin());
  for (const neighbours_t& neighbours : message->neighbours)
    if (!append_neighbours(neighbours, set.bearings.size(), set)) return std::nullopt;
  return set;
}

/// The values are not normalised, because they may be compared bit for bit.
std::optional<pose_cov_t> decode_pose(Bytes data) {
  if (data.size() != empty_size<pose_cov_t>()) return std::nullopt;
  return decode_checked<pose_cov_t>(data);
}

std::optional<pose_t> decode_bot_pose(Bytes data) {
  if (data.size() != empty_size<pose_t>()) return std::nullopt;
  return decode_checked<pose_t>(data);
}

std::optional<map_chunk_t> decode_map_chunk(Bytes data) {
  std::optional<map_chunk_t> chunk = decode_array<map_chunk_t, landmark_t>(data);
  if (!chunk || !is_a_piece(*chunk)) return std::nullopt;
  const auto good = [](const landmark_t& landmark) { return is_plausible(landmark); };
  return std::ranges::all_of(chunk->landmarks, good) ? std::move(chunk) : std::nullopt;
}

std::optional<path_t> decode_path(Bytes data) {
  std::optional<path_t> piece = decode_array<path_t, path_pose_t>(data);
  if (!piece || !is_a_piece(*piece)) return std::nullopt;
  return std::ranges::all_of(piece->poses, is_plausible_pose) ? std::move(piece) : std::nullopt;
}

std::optional<sightings_t> decode_sightings(Bytes data) {
  std::optional<sightings_t> message = decode_array<sightings_t, sighting_t>(data);
  const auto is_sound = [](const sighting_t& sighting) {
    return is_angle_or_degrees(sighting.azimuth_rad) &&
           (std::isnan(sighting.elevation_rad) || is_angle_or_degrees(sighting.elevation_rad));
  };
  return message && std::ranges::all_of(message->sightings, is_sound) ? std::move(message) : std::nullopt;
}

std::optional<expectations_t> decode_expectations(Bytes data) {
  std::optional<expectations_t> message = decode_array<expectations_t, expected_bearing_t>(data);
  const auto is_sound = [](const expected_bearing_t& expected) {
    return is_plausible_azimuth(expected.azimuth_rad) &&
           (std::isnan(expected.elevation_rad) || is_plausible_elevation(expected.elevation_rad));
  };
  if (!message || !(message->nis >= 0.0) || std::isinf(message->nis) || message->compared < 0) return std::nullopt;
  return std::ranges::all_of(message->expected, is_sound) ? std::move(message) : std::nullopt;
}

std::optional<kept_t> decode_kept(Bytes data) {
  if (data.size() != empty_size<kept_t>()) return std::nullopt;
  std::optional<kept_t> message = decode_checked<kept_t>(data);
  const bool is_sound = message && message->log_size >= -1 && message->log_quota >= 0 && message->disk_free >= -1 &&
                        is_plausible_stamp(message->map_utime);
  return is_sound ? message : std::nullopt;
}

std::optional<status_t> decode_status(Bytes data) {
  assert(std::accumulate(kBetweenTexts.begin(), kBetweenTexts.end(), 5 * (kBetweenTexts.size() - 1)) ==
         empty_size<status_t>());
  return texts_fit(data) ? decode_checked<status_t>(data) : std::nullopt;
}

std::optional<document_t> decode_document(Bytes data) {
  // preamble, int32 name length with the closing NUL, name, int32 size, data
  if (data.size() < empty_size<document_t>()) return std::nullopt;
  const std::size_t name_length = uint32_at(data, kPreambleSize);
  const std::size_t room = data.size() - kPreambleSize - 8;
  if (name_length > room || !is_text(data.subspan(kPreambleSize + 4, name_length))) return std::nullopt;
  if (uint32_at(data, kPreambleSize + 4 + name_length) != room - name_length) return std::nullopt;
  return decode_checked<document_t>(data);
}

std::vector<TrueLandmark> true_landmarks(const map_chunk_t& chunk) {
  std::vector<TrueLandmark> landmarks;
  for (const landmark_t& landmark : chunk.landmarks) {
    landmarks.push_back({.identity = landmark.identity >= 0 ? landmark.identity : landmark.id,
                         .x_m = landmark.x_m,
                         .y_m = landmark.y_m,
                         .z_m = landmark.z_m,
                         .kind = {}});
  }
  return landmarks;
}

}  // namespace azimuth
