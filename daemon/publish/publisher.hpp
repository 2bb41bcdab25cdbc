#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "daemon/publish/lcm_sender.hpp"
#include "daemon/publish/messages.hpp"
#include "daemon/publish/publish_settings.hpp"
#include "daemon/publish/status.hpp"
#include "drivers/storage/session.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Decides whether the past poses have moved so far that a receiver of the path needs a new one. The receiver got the
/// path once and has appended every pose since then.
///
/// Thread contract: thread-bound. Allocates only when the path grows.
class PathWatch {
 public:
  static constexpr double kMoved_m = 0.05, kTurned_rad = 0.02;

  /// `path` is the current path, oldest pose first. True: a pose is farther than these limits from the pose sent
  /// before, or the end of the sent path is missing, or no path has been sent yet. Poses in between may be added or
  /// removed.
  bool look(std::span<const PathPose> path);
  /// Records that `path` was sent.
  void sent(std::span<const PathPose> path);

 private:
  std::vector<PathPose> told_;
  bool any_sent_ = false;
};

/// Sends estimates, samples, the map, the path and the status over LCM. Poses and samples are sent when they arrive,
/// the map and the status at their rates and once more at the end, the path when past poses have moved.
///
/// Thread contract: thread-bound.
class Publisher {
 public:
  using Clock = std::chrono::steady_clock;
  /// Called for every message except samples, with the channel without its prefix, the encoded message, and its utime.
  using Listener = std::function<void(std::string_view channel, std::span<const std::byte> message, Stamp utime)>;

  /// `epoch_minus_monotonic` is the offset of the stamps from CLOCK_MONOTONIC; none: the stamps are those of a
  /// recording.
  explicit Publisher(const PublishSettings& settings, std::optional<Duration> epoch_minus_monotonic = {});

  /// Sets the documents that a log of the messages needs for a replay: the rig and the settings of the estimator. They
  /// are sent at once, and again now and then for programs that start to listen later. Documents about the start are
  /// not sent. Call it before the first message.
  void documents(std::vector<Document> documents);

  /// Adds a listener. Call it before the first message.
  void listen(Listener listener) { listeners_.push_back(std::move(listener)); }

  /// Sends the estimate of a step. Swaps `result` with the previous one and keeps it for the map.
  void step(StepResult& result);
  /// Sends a pose between two steps, unless a newer pose has been sent.
  void prediction(const Estimate& estimate);
  void odometry(const OdometryReading& reading);
  void bearings(const BearingSet& set);

  /// True: the path is to be requested. At most every few seconds; the longer the path, the less often.
  bool wants_path(Clock::time_point now);
  /// Sends the current path, oldest pose first, if past poses have moved (see PathWatch) or the drive has just begun.
  void path(std::span<const PathPose> path);
  /// Sends the last path unless it is empty, even if nothing has moved.
  void last_path(std::span<const PathPose> path);

  /// Makes the next status due early, because something has happened that people should know soon.
  void hasten_status();

  /// Sends everything that is due. True: a status was sent and has been written to `status`. The caller fills in the
  /// wires, devices and logs in `status` before the call; the publisher fills in the rest.
  bool send_due(Clock::time_point now, Status& status);
  /// Sends the last map and status, even if they are not due.
  void send_last(Clock::time_point now, Status& status);

 private:
  void send_pose(const Estimate& estimate);
  void send_sightings();
  void send_expectations();
  void send_map();
  void send_path(std::span<const PathPose> path);
  void send_kept(const Status& status);
  void send_status(Status& status, Clock::time_point now);
  void send_documents();
  template <class Message>
  void send(std::string_view channel, Message& message);
  std::int64_t monotonic_us(Stamp stamp) const;

  PublishSettings settings_;
  std::optional<Duration> epoch_minus_monotonic_;
  LcmSender sender_;
  std::vector<Listener> listeners_;
  StepResult last_step_;
  Estimate last_pose_;  // newest pose, of a step or predicted; without landmarks
  bool any_estimate_ = false;
  Clock::time_point last_status_{};
  std::optional<Clock::time_point> next_map_, next_status_, next_documents_, next_path_;
  std::vector<Document> documents_;
  std::uint64_t published_ = 0, maps_ = 0, statuses_ = 0, documents_sent_ = 0;
  map_chunk_t map_message_;
  PaceWatch pace_watch_;
  PathWatch path_watch_;
  std::size_t path_poses_ = 0;  // length of the newest path
  std::uint64_t paths_ = 0;     // number of paths sent
  path_t path_message_;
  sightings_t sightings_message_;
  expectations_t expectations_message_;
};

}  // namespace azimuth
