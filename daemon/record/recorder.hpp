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

/// Records what the estimator was given and what the daemon published, in LCM's log format, into segments of a session
/// folder: FOLDER/2026-11-21T13-05-00Z/000.lcm and so on. See SegmentedLog for what survives, and for disks in trouble.
///
/// Thread contract: thread-bound; not for real-time threads (a slow disk blocks the caller). While a segment is being
/// written nothing allocates once storage has grown.
class Recorder {
 public:
  using Clock = SegmentedLog::Clock;

  /// Begins the first segment at once. `documents` begin every segment; a rig.toml among them makes it replayable.
  Recorder(const RecordSettings& settings, std::vector<Document> documents,
           EventTimes times = EventTimes::of_recording(Stamp{}));

  // In the order in which the estimator takes them.
  void odometry(const OdometryReading& reading);
  void bearings(const BearingSet& set);

  /// A message published on `channel`, to which the prefix is to be added. Odometry and bearings are left out: they are
  /// recorded as the estimator takes them.
  void message(std::string_view channel, Bytes data);

  /// Does what is due: flush, next segment, making room, another try. To be called several times a flush interval.
  void turn(Clock::time_point now);

  const RecorderStatus& status() const { return on_ ? log_.status() : off_; }
  /// Name of the session's folder; empty until that is made.
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
