#pragma once
// Samples as LCM messages, and back.
//
// The decoding functions accept bytes from any origin. They check fingerprint, lengths and counts before the generated
// code reads them, because that code would throw, or allocate any claimed length. They refuse implausible values
// (plausible.hpp). Stamps are the messages' utime, exact to the microsecond.
//
// Thread contract: reentrant.

#include <azimuth/bearings_t.hpp>
#include <azimuth/document_t.hpp>
#include <azimuth/expectations_t.hpp>
#include <azimuth/features_t.hpp>
#include <azimuth/kept_t.hpp>
#include <azimuth/map_chunk_t.hpp>
#include <azimuth/odometry_t.hpp>
#include <azimuth/path_t.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <azimuth/pose_t.hpp>
#include <azimuth/sightings_t.hpp>
#include <azimuth/status_t.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/bytes.hpp"
#include "drivers/wire/truth.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

odometry_t to_message(const OdometryReading& reading);
/// True: bearings_t can represent the whole set, which has no kinds, no noise of its own, no descriptors and no
/// trouble. Such sets are sent as bearings_t, others as features_t.
bool is_plain(const BearingSet& set);
/// The message of a plain set. Of any other set, only the plain data are written.
bearings_t to_message(const BearingSet& set);
/// The message of any set of at most features_t::MAX_FEATURES bearings.
features_t to_features_message(const BearingSet& set);
odometry_t to_message(const TruthPose& truth, std::int64_t sequence);
document_t to_message(std::string_view name, std::string_view text, Stamp stamp);
// Like to_message(), but reuses the storage of `message`.
void fill_message(const BearingSet& set, bearings_t& message);
void fill_message(const BearingSet& set, features_t& message);
/// The true map in pieces of at most map_chunk_t::MAX_LANDMARKS; kinds are left out.
std::vector<map_chunk_t> to_messages(std::span<const TrueLandmark> landmarks, Stamp stamp);

// None when the bytes are not a valid message of the type.
std::optional<OdometryReading> decode_odometry(Bytes data);
std::optional<BearingSet> decode_bearings(Bytes data);
std::optional<BearingSet> decode_features(Bytes data);
std::optional<TruthPose> decode_truth(Bytes data);
std::optional<pose_cov_t> decode_pose(Bytes data);
std::optional<pose_t> decode_bot_pose(Bytes data);
std::optional<map_chunk_t> decode_map_chunk(Bytes data);
std::optional<path_t> decode_path(Bytes data);
std::optional<status_t> decode_status(Bytes data);
std::optional<sightings_t> decode_sightings(Bytes data);
std::optional<expectations_t> decode_expectations(Bytes data);
std::optional<kept_t> decode_kept(Bytes data);
std::optional<document_t> decode_document(Bytes data);

/// The landmarks in a piece of the true map.
std::vector<TrueLandmark> true_landmarks(const map_chunk_t& chunk);

/// Encodes `message` into `out`, reusing its storage.
template <class Message>
void encode(const Message& message, std::vector<std::byte>& out) {
  out.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(out.data(), 0, static_cast<int>(out.size()));
}

}  // namespace azimuth
