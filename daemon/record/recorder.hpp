#pragma once
#include <azimuth/bearings_t.hpp>
#include <azimuth/features_t.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/record/event_times.hpp"
#include "daemon/record/record_settings.hpp"
#include "daemon/record/segmented_log.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Records the samples that the estimator took and the messages that the daemon published, in LCM's log format. The
/// segments lie in a session folder: FOLDER/2026-11-21T13-05-00Z/000.lcm and so on. SegmentedLog tells which data
/// survive a failure, and what happens when the disk is in trouble.
///
/// Thread contract: thread-bound; not for real-time threads (a slow disk blocks the caller). While a segment is being
/// written, nothing allocates once the storage has grown.
class Recorder {
 public:
  using Clock = SegmentedLog::Clock;

  /// Starts the first segment at once. Every segment starts with `documents`; rig.toml among them makes it replayable.
  Recorder(const RecordSettings& settings, std::vector<Document> documents,
           EventTimes times = EventTimes::of_recording(Stamp{}));

  // To be called in the order in which the estimator takes the samples.
  void odometry(const OdometryReading& reading);
  void bearings(const BearingSet& set);

  /// Records a message published on `channel`, a name without the prefix. Odometry and bearings are skipped, because
  /// they are recorded when the estimator takes them.
  void message(std::string_view channel, Bytes data);

  /// Does everything that is due: flush, start the next segment, make room, try again after trouble. To be called
  /// several times per flush interval.
  void turn(Clock::time_point now);

  const RecorderStatus& status() const { return on_ ? log_.status() : off_; }
  /// Name of the session's folder; empty until the folder exists.
  const std::string& session() const { return log_.session(); }

 private:
  bool on_;
  RecorderStatus off_;
  std::string prefix_, odometry_channel_, bearings_channel_, features_channel_, message_channel_;
  EventTimes times_;
  SegmentedLog log_;
  bearings_t bearings_message_{};
  features_t features_message_{};
  std::vector<std::byte> data_;
};

}  // namespace azimuth
