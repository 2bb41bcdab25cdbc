#pragma once
// The report of a replay: accuracy of the poses and the map, and computing time. The report depends only on the input.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/evaluate/health_report.hpp"
#include "tools/evaluate/map_error.hpp"
#include "tools/evaluate/pose_error.hpp"
#include "tools/evaluate/sighting_error.hpp"
#include "tools/evaluate/statistics.hpp"
#include "tools/evaluate/trajectory.hpp"

namespace azimuth {

/// Numbers of usable and unusable images.
struct ImagesReport {
  std::size_t images = 0;  ///< 0 if the run contains bearings instead of images
  std::size_t unreadable = 0;
  std::size_t of_no_use = 0;  ///< readable, but dark, overexposed, covered, frozen or torn
};

struct AssociationReport {
  std::uint64_t accepted = 0;
  std::uint64_t rejected = 0;
  std::uint64_t created = 0;  ///< initialised landmarks, reported as "new"
  SightingErrors sightings;   ///< wrong associations among the accepted bearings; none are judged without truth
};

/// Durations in microseconds, one for each step.
struct StepTimes {
  // decode_us and detect_us are times of the image front end. They are empty if the run contains bearings.
  std::vector<double> decode_us;  ///< reading and decoding an image
  std::vector<double> detect_us;  ///< finding bearings in it
  std::vector<double> update_us;  ///< the estimator's update()
  std::vector<double> step_us;    ///< everything from sample to estimate
};

/// The complete output of a replay.
struct ReplayRecord {
  std::string run;
  std::string estimator;
  std::string front_end;
  std::uint64_t seed = 0;
  std::string health;  ///< health at the end
  std::string digest;  ///< digest of all estimates; equal digests mean bit-identical estimates

  std::vector<EstimateRecord> estimates;                      ///< sorted by stamp
  std::vector<EstimateRecord> past;                           ///< smoothed path, sorted by stamp; may be empty
  std::vector<SightingRecord> sightings;                      ///< accepted bearings
  Eigen::Vector2d p_body_camera_m = Eigen::Vector2d::Zero();  ///< position of the camera on the robot
  std::vector<NamedPoint> map;                                ///< landmarks at the end, map frame
  /// Number of landmarks in `map` that are accurate enough for a saved map; nothing if no map would be saved.
  std::optional<std::size_t> settled_landmarks;
  /// True if the landmarks are natural features, whose true positions are unknown. A feature near a true landmark is
  /// then not necessarily an estimate of it.
  bool natural_features = false;
  std::vector<StepHealth> healths;         ///< one for each estimate; empty if the estimates have no health
  std::string input_trouble;               ///< reason why samples were unusable; empty if none
  std::string incomplete;                  ///< unreadable part of the recording; empty if none
  std::vector<StampedPose> raw_odometry;   ///< uncalibrated readings; empty if odometry is not evaluated
  std::vector<DrivenBy> driven;            ///< distance driven at each odometry reading
  std::vector<StampedPose> truth;          ///< T_world_body; may be empty
  std::vector<NamedPoint> true_landmarks;  ///< world frame

  AssociationReport association;
  ImagesReport images;
  StepTimes times;
  double peak_memory_mb = kNotMeasured, resident_memory_mb = kNotMeasured;
};

/// Accuracy of the smoothed path that is known at the end.
struct HindsightReport {
  ErrorStatistics position_m;
  ErrorStatistics heading_rad;
  Consistency consistency;
  MapError map;  ///< error of the final map with the alignment of the smoothed path
};

/// Labels that distinguish a report from others.
struct ReportLabel {
  std::string name;  ///< empty if none was given
  std::vector<std::string> tags;
  std::vector<std::string> overrides;  ///< overridden settings, `section.key=value`
  std::string made_by;                 ///< program and version
};

struct Report {
  ReportLabel label;
  std::string run, estimator, front_end;
  std::uint64_t seed = 0;
  std::string health, digest, input_trouble, incomplete;
  std::size_t steps = 0;
  HealthReport health_over_time;

  ErrorStatistics position_m;  ///< `count` is the number of estimates with truth
  ErrorStatistics heading_rad;
  Eigen::Vector3d two_sigma_final{kNotMeasured, kNotMeasured, kNotMeasured};  ///< (x [m], y [m], heading [rad]), map
  Consistency consistency;
  Consistency tracking_consistency;              ///< only estimates whose health is `tracking`
  std::optional<HindsightReport> hindsight;      ///< nothing if the estimator does not revise past poses
  ErrorStatistics odometry_m;                    ///< calibrated odometry alone, with its own alignment
  ErrorStatistics odometry_raw_m;                ///< uncalibrated odometry alone, with its own alignment
  std::optional<std::size_t> settled_landmarks;  ///< see ReplayRecord
  bool natural_features = false;                 ///< see ReplayRecord; if true, no map errors are computed
  MapError map;
  NamedMapError named_map;
  SpaceMapError space_map;
  AssociationReport association;
  ImagesReport images;
  TimeStatistics decode, detect, update, step;
  double image_period_us = kNotMeasured;  ///< median interval between the images of successive steps
  double peak_memory_mb = kNotMeasured, resident_memory_mb = kNotMeasured;

  std::optional<Pose2> T_world_map;   ///< alignment of the estimates; nothing without truth
  std::optional<Pose2> T_world_odom;  ///< alignment of calibrated odometry; nothing without truth
};

Report evaluate(const ReplayRecord& record);

/// A sentence, with the key to change, if the mean duration of a step exceeds the interval between images, so that a
/// daemon on this machine would skip images. Empty if the machine is fast enough or if this is unknown.
std::string why_too_slow(const Report& report);

/// The report as one indented JSON object with a final newline. Values that were not measured are null.
std::string to_json(const Report& report);

}  // namespace azimuth
