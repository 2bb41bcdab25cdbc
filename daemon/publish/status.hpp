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

/// An estimate on its way to the publisher, with the digest of all steps up to it.
struct StepResult {
  Estimate estimate;
  std::uint64_t digest = 0;
  ExpectedImage expected;  ///< before it; without a stamp: nobody looked
};

/// How a device is, for a person, and what the robot says of itself.
struct DeviceStatus {
  std::string text;  ///< e.g. "running (p3dx-sh GJC_3156)"; empty: there is no such device
  bool works = false;
  std::chrono::steady_clock::duration away{};  ///< for how long it has not worked
  std::uint64_t reconnects = 0;
  std::uint64_t port_resets = 0;     ///< of its USB port
  std::uint64_t images_missing = 0;  ///< of a camera, by its sequence numbers
  std::uint64_t images_corrupt = 0;  ///< those that came from a camera of the daemon's own, but damaged
  double battery_v = std::numeric_limits<double>::quiet_NaN();
  std::uint32_t robot_flags = 0;  ///< bits of status_t::ROBOT_*

  /// There is to be such a device, and nothing comes from it.
  bool is_away() const { return !works && !text.empty(); }
};

/// What became of the images.
struct PerceptionStatus {
  std::uint64_t frames = 0;                          ///< looked at
  std::uint64_t frames_unusable = 0;                 ///< of them, those with a trouble
  ImageTrouble trouble = ImageTrouble::none;         ///< of the newest
  double detect_mean_us = 0.0, detect_max_us = 0.0;  ///< what an image of the last second cost
};

/// How the field log is.
struct RecordStatus {
  std::string text;  ///< the file being written, or why nothing is; empty: no log was asked for
  std::uint64_t losses = 0;
  std::uint64_t kept_bytes = 0;          ///< in its folder, of all sessions
  std::uint64_t quota_bytes = 0;         ///< they may be so many together; 0: no quota
  std::optional<std::uint64_t> free_mb;  ///< on its disk, when last asked; unknown until then
};

/// How the saved map is.
struct MapStatus {
  std::string text;             ///< what became of the last one; empty: none is kept
  bool trouble = false;         ///< it could not be loaded or saved
  std::int64_t written_us = 0;  ///< when the one on the disk was, since the Unix epoch; 0: there is none
};

/// How the process itself is.
struct ProcessStatus {
  std::string realtime;           ///< what of it is in force and what was refused; empty: nothing was asked for
  bool realtime_refused = false;  ///< some of it
  std::string configuration;      ///< what became of one that was refused while the daemon ran; empty: none was
};

/// What the wires between the threads lost since the start.
struct WireLosses {
  std::uint64_t odometry_refused = 0;
  std::uint64_t bearings_refused = 0;
  std::uint64_t frames_replaced = 0;
  std::uint64_t estimates_replaced = 0;
  std::uint64_t echoes_refused = 0;
  std::uint64_t records_refused = 0;
};

/// How the daemon is, once a second: for LCM, systemd and the status line.
struct Status {
  bool any_estimate = false;
  Estimate estimate;  ///< the newest; without landmarks
  std::size_t landmarks = 0;
  std::uint64_t published = 0;  ///< estimates, predicted ones included
  std::uint64_t digest = 0;     ///< of all steps
  WireLosses wires;
  std::uint64_t publish_failures = 0;
  DeviceStatus odometer, camera;
  PerceptionStatus perception;
  RecordStatus record;
  RecordStatus frame_record;  ///< of the images; empty: none are to be recorded
  MapStatus map;
  ProcessStatus process;
  SampleFinding samples;  ///< what keeps them from being of use
  std::string pace;       ///< that they come faster than they are worked off; empty: they do not
  std::string picture;    ///< why there are no pictures although they were asked for; empty: there are, or none were

  /// Samples that never reached the estimator or were out of order there.
  std::uint64_t samples_lost() const;
};

/// Health, and why.
struct ToldHealth {
  Health health;
  std::string_view reason;
};

/// What everybody is told: the estimator's own word on `estimate`, as far as what feeds it is there. It hears samples
/// alone, so that none come it cannot tell: a pose that is not fed by odometry is degraded, and lost after a while,
/// and one without images is degraded.
ToldHealth told_health(const Estimate& estimate, const DeviceStatus& odometer, const DeviceStatus& camera);

/// Pose, uncertainty and health for a person: "t 12.300 s  tracking  x 1.23 y 4.56 m  heading 78.9 deg  +-0.08 m".
std::string pose_line(const Estimate& estimate);

/// A duration for a person, in its two largest units: "8 s", "3 min 05 s", "2 h 14 min", "5 d 03 h".
std::string duration_text(std::chrono::seconds duration);

/// For how long the daemon has run, its health, what is in trouble, then pose, map and what became of the bearings: a
/// terminal that is too narrow cuts what is needed least.
std::string status_line(const Status& status, std::chrono::seconds uptime);

}  // namespace azimuth
