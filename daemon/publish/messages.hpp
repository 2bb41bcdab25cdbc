#pragma once
// The messages that the publisher sends. Messages for single estimates are in drivers/estimates, those for samples in
// drivers/wire/messages.hpp.

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

namespace azimuth {

/// A pose in the type that bot_core programs read. Velocities and accelerations are not estimated and are zero.
pose_t bot_pose_message(const Estimate& estimate);

/// Number of chunks into which the map is divided, at least one.
std::int32_t map_chunks(std::size_t landmarks);

/// Fills in chunk number `chunk` of the map, from 0. `sequence` counts maps.
void fill_map_chunk(std::span<const LandmarkEstimate> landmarks, Stamp stamp, std::uint64_t sequence,
                    std::int32_t chunk, map_chunk_t& message);

/// Number of chunks into which a path is divided, at least one.
std::int32_t path_chunks(std::size_t poses);

/// Fills in chunk number `chunk` of the path, from 0. `sequence` counts paths.
void fill_path_chunk(std::span<const PathPose> path, std::uint64_t sequence, std::int32_t chunk, path_t& message);

/// Fills in the bearings that corrected the estimate of a step. The storage of `message` is reused.
void fill_message(const Estimate& step, sightings_t& message);

/// Fills in the expected bearings of the step's image, and the residuals of the bearings that were used. Sorts
/// step.expected.bearings, those used first. If they are too many for one message, expected bearings that were not used
/// are left out.
void fill_message(StepResult& step, expectations_t& message);

/// The message about log and map on the disk. The caller fills in the sending time and the sequence number.
kept_t kept_message(const Status& status);

/// The message of the status. The caller fills in the sending time and the sequence number.
status_t status_message(const Status& status);

}  // namespace azimuth
