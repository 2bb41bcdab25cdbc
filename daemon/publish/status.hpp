#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "slam/estimator/estimate.hpp"

namespace azimuth {

/// An estimate on its way to the publisher, with the digest of all steps up to it.
struct StepResult {
  Estimate estimate;
  std::uint64_t digest = 0;
};

/// What the wires between the threads lost since the start.
struct WireLosses {
  std::uint64_t odometry_refused = 0;
  std::uint64_t bearings_refused = 0;
  std::uint64_t estimates_replaced = 0;
  std::uint64_t echoes_refused = 0;
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

  /// Samples that never reached the estimator or were out of order there.
  std::uint64_t samples_lost() const;
};

/// Pose, uncertainty and health for a person: "t 12.300 s  tracking  x 1.23 y 4.56 m  heading 78.9 deg  +-0.08 m".
std::string pose_line(const Estimate& estimate);

/// The same with the map and what became of the bearings.
std::string status_line(const Status& status);

}  // namespace azimuth
