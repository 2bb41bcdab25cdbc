#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/file_result.hpp"

namespace azimuth {

/// The part of the plane that poses lie in.
struct PoseBox {
  double min_x_m = 0.0, min_y_m = 0.0, max_x_m = 0.0, max_y_m = 0.0;
};

/// What a field log says of its drive, without any of it being estimated again.
struct LogSummary {
  std::int64_t first_us = 0, last_us = 0;  ///< when its first and its last event were recorded, since the epoch
  std::string prefix;                      ///< of its channels
  std::string version;                     ///< of the daemon; empty: it does not say
  std::string odometer;                    ///< the robot, as the odometer's driver calls it; empty: it does not say
  std::string rig_toml, configuration_toml;

  std::uint64_t poses = 0;             ///< of steps
  std::array<double, 4> health_s{};    ///< how long the robot was in each state, by its code in pose_cov_t
  double silent_s = 0.0;               ///< without a pose for longer than kLongestSilence_s
  double distance_m = 0.0;             ///< along the calibrated odometry
  std::optional<PoseBox> box;          ///< of the steps' poses in the map
  std::uint64_t malformed = 0;         ///< poses, status and documents that this version cannot read
  std::uint64_t damaged_bytes = 0;     ///< of no whole event, a cut last one included
  std::uint64_t missing_segments = 0;  ///< of the session, before its first one and between them
  std::uint64_t lost_events = 0;       ///< which the daemon could not write

  /// Between two poses that follow each other.
  static constexpr double kLongestSilence_s = 5.0;
};

/// Reads a log, or the segments of a session folder. Its channels may have any prefix: that of the first document or
/// pose counts. Refuses what holds no whole event. Reentrant.
FileResult<LogSummary> read_log_summary(const std::filesystem::path& log_or_session);

}  // namespace azimuth
