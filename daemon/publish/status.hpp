#pragma once
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "daemon/publish/expected_image.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/estimator/sample_watch.hpp"

namespace azimuth {

/// The estimate of a step on its way to the publisher, with the digest of all steps so far.
struct StepResult {
  Estimate estimate;
  std::uint64_t digest = 0;
  ExpectedImage expected;  ///< the expected bearings before the step; no stamp: not computed
};

/// The state of a device as text, and the robot's own report.
struct DeviceStatus {
  std::string text;  ///< e.g. "running (p3dx-sh GJC_3156)"; empty: there is no such device
  bool works = false;
  std::chrono::steady_clock::duration away{};  ///< how long the device has not worked
  std::uint64_t reconnects = 0;
  std::uint64_t port_resets = 0;     ///< resets of the device's USB port
  std::uint64_t images_missing = 0;  ///< images missing in a camera's sequence numbers
  std::uint64_t images_corrupt = 0;  ///< damaged images from a camera that the daemon opens itself
  double battery_v = std::numeric_limits<double>::quiet_NaN();
  std::uint32_t robot_flags = 0;  ///< bits of status_t::ROBOT_*

  /// True: the device is configured but sends nothing.
  bool is_away() const { return !works && !text.empty(); }
};

/// The counters of processed images.
struct PerceptionStatus {
  std::uint64_t frames = 0;                          ///< images processed
  std::uint64_t frames_unusable = 0;                 ///< of these, images with a trouble
  ImageTrouble trouble = ImageTrouble::none;         ///< trouble of the newest image
  double detect_mean_us = 0.0, detect_max_us = 0.0;  ///< processing time per image over the last second
};

/// The state of a field log.
struct RecordStatus {
  std::string text;  ///< the file being written, or why no file is written; empty: no log was requested
  std::uint64_t losses = 0;
  std::uint64_t kept_bytes = 0;          ///< size of all sessions in the log's folder
  std::uint64_t quota_bytes = 0;         ///< limit of kept_bytes; 0: no quota
  std::optional<std::uint64_t> free_mb;  ///< free space on the log's disk when last checked; none: not checked yet
};

/// The state of the saved map.
struct MapStatus {
  std::string text;             ///< what happened to the last map; empty: no map is kept
  bool trouble = false;         ///< the map could not be loaded or saved
  std::int64_t written_us = 0;  ///< when the map on the disk was written [us since the Unix epoch]; 0: there is none
};

/// The state of the process itself.
struct ProcessStatus {
  std::string realtime;           ///< real-time settings in force and refused; empty: none were requested
  bool realtime_refused = false;  ///< some of them were refused
  /// Why a new configuration was refused while the daemon was running; empty: none was refused.
  std::string configuration;
};

/// Samples that the wires between the threads have lost since the start.
struct WireLosses {
  std::uint64_t odometry_refused = 0;
  std::uint64_t bearings_refused = 0;
  std::uint64_t frames_replaced = 0;
  std::uint64_t estimates_replaced = 0;
  std::uint64_t echoes_refused = 0;
  std::uint64_t records_refused = 0;
};

/// The state of the daemon, once a second, for LCM, systemd and the status line.
struct Status {
  bool any_estimate = false;
  Estimate estimate;  ///< the newest estimate, without landmarks
  std::size_t landmarks = 0;
  std::uint64_t published = 0;  ///< number of estimates, including predicted ones
  std::uint64_t digest = 0;     ///< digest of all steps
  WireLosses wires;
  std::uint64_t publish_failures = 0;
  DeviceStatus odometer, camera;
  PerceptionStatus perception;
  RecordStatus record;
  RecordStatus frame_record;  ///< the log of the images; empty: no images are to be recorded
  MapStatus map;
  ProcessStatus process;
  SampleFinding samples;  ///< why the samples are of no use
  /// A message that samples arrive faster than they are processed; empty: they do not.
  std::string pace;
  /// Why requested pictures are not made; empty: they are made, or none were requested.
  std::string picture;

  /// Number of samples that did not reach the estimator or reached it out of order.
  std::uint64_t samples_lost() const;
};

/// The published health and its reason.
struct ToldHealth {
  Health health;
  std::string_view reason;
};

/// Returns the health that is published: the estimator's own health, lowered when its sources fail. The estimator sees
/// only samples and does not notice their absence. Without odometry a pose is degraded, and lost after a while; without
/// images it is degraded.
ToldHealth told_health(const Estimate& estimate, const DeviceStatus& odometer, const DeviceStatus& camera);

/// Pose, uncertainty and health for a person: "t 12.300 s  tracking  x 1.23 y 4.56 m  heading 78.9 deg  +-0.08 m".
std::string pose_line(const Estimate& estimate);

/// A duration for a person, in its two largest units: "8 s", "3 min 05 s", "2 h 14 min", "5 d 03 h".
std::string duration_text(std::chrono::seconds duration);

/// One line with the time since the start, health, troubles, pose, map and counters of the bearings. The least
/// important text comes last, because a narrow terminal cuts it off.
std::string status_line(const Status& status, std::chrono::seconds uptime);

/// Notices when images or bearings arrive faster than they are processed. Some of them are then skipped, and the pose
/// becomes less accurate. The caller passes the counters of the status now and then, and the watch judges them over
/// several seconds.
///
/// Thread contract: thread-bound.
class PaceWatch {
 public:
  using Clock = std::chrono::steady_clock;

  void look(Clock::time_point now, const Status& status);
  /// A message for a person that names a remedy; empty: all images and bearings are used.
  const std::string& text() const { return text_; }

 private:
  struct Counts {
    Clock::time_point at{};
    std::uint64_t looked = 0, replaced = 0, refused = 0, steps = 0;
  };
  static std::string judged(const Counts& before, const Counts& now, double detect_mean_us);

  Counts before_;
  std::string text_;
};

}  // namespace azimuth
