#pragma once
// The report of a replay: how good the poses and the map are, and what they cost. Pure: the same input, the same
// report.

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

/// What became of the images.
struct ImagesReport {
  std::size_t images = 0;  ///< 0: the run brought bearings
  std::size_t unreadable = 0;
  std::size_t of_no_use = 0;  ///< read, but dark, overexposed, covered, frozen or torn
};

struct AssociationReport {
  std::uint64_t accepted = 0;
  std::uint64_t rejected = 0;
  std::uint64_t created = 0;  ///< reported as "new"
  SightingErrors sightings;   ///< of the accepted ones; those judged are none without truth
};

/// Durations in microseconds, one for each step.
struct StepTimes {
  // Of the image front end; empty when the run brought bearings.
  std::vector<double> decode_us;  ///< reading and decoding an image
  std::vector<double> detect_us;  ///< finding bearings in it
  std::vector<double> update_us;  ///< the estimator's update()
  std::vector<double> step_us;    ///< everything from sample to estimate
};

/// Everything a replay hands over.
struct ReplayRecord {
  std::string run;
  std::string estimator;
  std::string front_end;
  std::uint64_t seed = 0;
  std::string health;  ///< at the end
  std::string digest;  ///< of all estimates: equal digests, equal bits

  std::vector<EstimateRecord> estimates;                      ///< sorted by stamp
  std::vector<EstimateRecord> past;                           ///< in hindsight, likewise; empty: there is none
  std::vector<SightingRecord> sightings;                      ///< accepted
  Eigen::Vector2d p_body_camera_m = Eigen::Vector2d::Zero();  ///< where they were seen from
  std::vector<NamedPoint> map;                                ///< landmarks at the end, map frame
  /// Landmarks of `map` that a saved map would keep, being known well enough; nothing: none would be saved.
  std::optional<std::size_t> settled_landmarks;
  /// The map is made of whatever there is to see, of which nobody knows the true places: what stands near a true
  /// landmark is not for that reason its estimate.
  bool natural_features = false;
  std::vector<StepHealth> healths;         ///< one for each estimate; empty: they do not say
  std::string input_trouble;               ///< what kept samples from being of use; empty: nothing
  std::string incomplete;                  ///< what of the recording could not be read; empty: nothing
  std::vector<StampedPose> raw_odometry;   ///< as read, uncalibrated; empty: no odometry to judge
  std::vector<DrivenBy> driven;            ///< at each reading of it
  std::vector<StampedPose> truth;          ///< T_world_body; may be empty
  std::vector<NamedPoint> true_landmarks;  ///< world frame

  AssociationReport association;
  ImagesReport images;
  StepTimes times;
  double peak_memory_mb = kNotMeasured, resident_memory_mb = kNotMeasured;
};

/// How good the path is as it is known at the end.
struct HindsightReport {
  ErrorStatistics position_m;
  ErrorStatistics heading_rad;
  Consistency consistency;
  MapError map;  ///< the map at the end, laid over the truth as that path is
};

/// What tells a report from others; nothing of it is measured.
struct ReportLabel {
  std::string name;  ///< empty: none was given
  std::vector<std::string> tags;
  std::vector<std::string> overrides;  ///< of settings, `section.key=value`
  std::string made_by;                 ///< program and version
};

struct Report {
  ReportLabel label;
  std::string run, estimator, front_end;
  std::uint64_t seed = 0;
  std::string health, digest, input_trouble, incomplete;
  std::size_t steps = 0;
  HealthReport health_over_time;

  ErrorStatistics position_m;  ///< its count is the number of estimates with truth
  ErrorStatistics heading_rad;
  Eigen::Vector3d two_sigma_final{kNotMeasured, kNotMeasured, kNotMeasured};  ///< (x [m], y [m], heading [rad]), map
  Consistency consistency;
  Consistency tracking_consistency;              ///< of the estimates that said `tracking`
  std::optional<HindsightReport> hindsight;      ///< nothing: the estimator decides at once and never again
  ErrorStatistics odometry_m;                    ///< calibrated odometry alone, with its own alignment
  ErrorStatistics odometry_raw_m;                ///< as read, with its own alignment
  std::optional<std::size_t> settled_landmarks;  ///< as in the record
  bool natural_features = false;                 ///< likewise; then no map is compared with the true landmarks
  MapError map;
  NamedMapError named_map;
  SpaceMapError space_map;
  AssociationReport association;
  ImagesReport images;
  TimeStatistics decode, detect, update, step;
  double image_period_us = kNotMeasured;  ///< from one step's image to the next, median
  double peak_memory_mb = kNotMeasured, resident_memory_mb = kNotMeasured;

  std::optional<Pose2> T_world_map;   ///< the alignment; nothing without truth
  std::optional<Pose2> T_world_odom;  ///< likewise of calibrated odometry
};

Report evaluate(const ReplayRecord& record);

}  // namespace azimuth
