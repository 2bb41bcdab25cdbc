#pragma once
// What goes out but single estimates, which are in drivers/estimates, and samples, in drivers/wire/messages.hpp.

#include <azimuth/expectations_t.hpp>
#include <azimuth/kept_t.hpp>
#include <azimuth/map_chunk_t.hpp>
#include <azimuth/path_t.hpp>
#include <azimuth/pose_t.hpp>
#include <azimuth/sightings_t.hpp>
#include <azimuth/status_t.hpp>
#include <span>

#include "daemon/publish/status.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/past_pose.hpp"

namespace azimuth {

/// The shape every bot_core program understands; velocities and accelerations are not estimated and zero.
pose_t bot_pose_message(const Estimate& estimate);

/// How many chunks the map takes, at least one.
std::int32_t map_chunks(std::size_t landmarks);

/// Piece `chunk` of the map, from 0; `sequence` counts maps.
void fill_map_chunk(std::span<const LandmarkEstimate> landmarks, Stamp stamp, std::uint64_t sequence,
                    std::int32_t chunk, map_chunk_t& message);

/// How many pieces a path takes, at least one.
std::int32_t path_chunks(std::size_t poses);

/// Piece `chunk` of the path, from 0; `sequence` counts paths.
void fill_path_chunk(std::span<const PathPose> path, std::uint64_t sequence, std::int32_t chunk, path_t& message);

/// Which bearings corrected the estimate of a step; `message` is used again.
void fill_message(const Estimate& step, sightings_t& message);

/// What was expected of the step's image, and how far off what was used was; what is expected is sorted by that. What
/// is too much for a message is left out, of landmarks that were not used.
void fill_message(StepResult& step, expectations_t& message);

/// Leaves time of sending and sequence number to the caller.
kept_t kept_message(const Status& status);

/// Leaves time of sending and sequence number to the caller.
status_t status_message(const Status& status);

}  // namespace azimuth
