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
#include "daemon/publish/pace_watch.hpp"
#include "daemon/publish/path_watch.hpp"
#include "daemon/publish/publish_settings.hpp"
#include "daemon/publish/status.hpp"
#include "drivers/storage/session.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// Sends estimates, samples, the map, the path and the status over LCM: poses and samples as they come, the map and the
/// status at their rates and once more at the end, the path when it has moved.
///
/// Thread contract: thread-bound.
class Publisher {
 public:
  using Clock = std::chrono::steady_clock;
  /// Told of everything sent but samples: the channel without its prefix, the encoded message, its utime.
  using Listener = std::function<void(std::string_view channel, std::span<const std::byte> message, Stamp utime)>;

  /// `epoch_minus_monotonic` is what stamps lead CLOCK_MONOTONIC by; none: they are those of a recording.
  explicit Publisher(const PublishSettings& settings, std::optional<Duration> epoch_minus_monotonic = {});

  /// What a log of the messages has to hold to be replayed: the rig, and what the estimator was told. Sent at once, and
  /// again now and then for those that begin to listen later. Documents of the start are left out. Before the first
  /// message.
  void documents(std::vector<Document> documents);

  /// Adds one more to those that are told. Before the first message.
  void listen(Listener listener) { listeners_.push_back(std::move(listener)); }

  /// The estimate of a step. Its storage is kept for the map and swapped for that of the last one.
  void step(StepResult& result);
  /// A pose between two steps; left out when a newer one has been sent.
  void prediction(const Estimate& estimate);
  void odometry(const OdometryReading& reading);
  void bearings(const BearingSet& set);

  /// Whether the path should be asked for: at most every few seconds, the less often the longer it is.
  bool wants_path(Clock::time_point now);
  /// The path as it is now, oldest first: sent when the past has moved (PathWatch), or the drive begins.
  void path(std::span<const PathPose> path);
  /// The one at the end: sent, whether it has moved or not, unless it is empty.
  void last_path(std::span<const PathPose> path);

  /// Something happened that people should hear of soon: the status is due as soon as the last one is no longer fresh.
  void hasten_status();

  /// Sends what is due by now. True when a status was among it; it is written to `status` then.
  /// The caller fills in what `status` says of wires, devices and the log; the rest is the publisher's.
  bool send_due(Clock::time_point now, Status& status);
  /// Sends the last map and status, whether due or not.
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
  Estimate last_pose_;  // of a step or predicted; without landmarks
  bool any_estimate_ = false;
  Clock::time_point last_status_{};
  std::optional<Clock::time_point> next_map_, next_status_, next_documents_, next_path_;
  std::vector<Document> documents_;
  std::uint64_t published_ = 0, maps_ = 0, statuses_ = 0, documents_sent_ = 0;
  map_chunk_t map_message_;
  PaceWatch pace_watch_;
  PathWatch path_watch_;
  std::size_t path_poses_ = 0;  // of the newest one
  std::uint64_t paths_ = 0;     // sent
  path_t path_message_;
  sightings_t sightings_message_;
  expectations_t expectations_message_;
};

}  // namespace azimuth
