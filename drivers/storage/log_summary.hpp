#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/file_result.hpp"

namespace azimuth {

/// The bounding box of poses in the plane.
struct PoseBox {
  double min_x_m = 0.0, min_y_m = 0.0, max_x_m = 0.0, max_y_m = 0.0;
};

/// The facts about a drive in a field log that need no new estimation.
struct LogSummary {
  /// When the first and the last event were recorded [us since the epoch].
  std::int64_t first_us = 0, last_us = 0;
  std::string prefix;   ///< prefix of the log's channels
  std::string version;  ///< version of the daemon; empty: unknown
  /// The robot, as the odometer's driver names it; empty: unknown.
  std::string odometer;
  std::string rig_toml, configuration_toml;

  std::uint64_t poses = 0;           ///< number of poses of steps
  std::array<double, 4> health_s{};  ///< time in each state of health, by its code in pose_cov_t
  /// Total time of gaps between poses longer than kLongestSilence_s.
  double silent_s = 0.0;
  double distance_m = 0.0;          ///< along the calibrated odometry
  std::optional<PoseBox> box;       ///< bounds of the steps' poses in the map
  std::uint64_t malformed = 0;      ///< poses, statuses and documents that this version cannot read
  std::uint64_t damaged_bytes = 0;  ///< bytes outside complete events, including a truncated last event
  /// Missing segments of the session, before the first one and between segments.
  std::uint64_t missing_segments = 0;
  std::uint64_t lost_events = 0;  ///< events that the daemon could not write

  /// A longer time between consecutive poses counts as silence.
  static constexpr double kLongestSilence_s = 5.0;
};

/// Reads a log, or the segments of a session folder. Its channels may have any prefix; the prefix of the first document
/// or pose is used. Refuses a recording without a complete event. Thread contract: reentrant.
FileResult<LogSummary> read_log_summary(const std::filesystem::path& log_or_session);

}  // namespace azimuth
