#pragma once
// All messages in a log of lcm-logger, decoded.

#include <azimuth/document_t.hpp>
#include <azimuth/expectations_t.hpp>
#include <azimuth/kept_t.hpp>
#include <azimuth/map_chunk_t.hpp>
#include <azimuth/path_t.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <azimuth/pose_t.hpp>
#include <azimuth/sightings_t.hpp>
#include <azimuth/status_t.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth::test {

struct RecordedMessages {
  std::vector<pose_cov_t> poses;
  std::vector<pose_t> bot_poses;
  std::vector<map_chunk_t> map_chunks;
  std::vector<path_t> paths;
  std::vector<status_t> statuses;
  std::vector<sightings_t> sightings;
  std::vector<expectations_t> expectations;
  std::vector<kept_t> kept;
  std::vector<document_t> documents;
  std::vector<OdometryReading> odometry;
  std::vector<BearingSet> bearings;
  std::vector<std::string> foreign_channels;
  std::size_t undecodable = 0;
  std::size_t largest_bytes = 0;

  /// Number of messages on Azimuth's channels.
  std::size_t count() const {
    return poses.size() + bot_poses.size() + map_chunks.size() + paths.size() + statuses.size() + sightings.size() +
           expectations.size() + kept.size() + documents.size() + odometry.size() + bearings.size() + undecodable;
  }
};

/// `prefix` is removed from every channel's name. A channel without the prefix is foreign.
RecordedMessages read_messages(const std::filesystem::path& log, const std::string& prefix = "");

}  // namespace azimuth::test
