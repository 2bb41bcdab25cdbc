#pragma once
// Converts the messages of a running daemon for display: into a state for clients that connect, and into events for
// connected clients.

#include <azimuth/expectations_t.hpp>
#include <azimuth/kept_t.hpp>
#include <azimuth/map_chunk_t.hpp>
#include <azimuth/path_t.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <azimuth/sightings_t.hpp>
#include <azimuth/status_t.hpp>
#include <chrono>
#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "drivers/wire/pieces.hpp"
#include "drivers/wire/truth.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/stamp.hpp"
#include "tools/view/lookers.hpp"
#include "tools/view/measured.hpp"
#include "tools/view/news.hpp"
#include "tools/view/shown_bearings.hpp"
#include "tools/view/shown_map.hpp"
#include "tools/view/times.hpp"
#include "tools/view/trail.hpp"

namespace azimuth {

/// Limits of the data that a live view stores and shows, for any input.
struct ViewLimits {
  std::size_t trail_points = 100'000;     ///< points of the estimate's trail, and of the truth's trail
  std::size_t trail_piece = 2'000;        ///< points in one event
  std::size_t landmarks = 5'000;          ///< shown landmarks; of further ones only the number is sent
  std::size_t path_points = 20'000;       ///< points of the smoothed path; longer paths are thinned
  std::size_t bearings = 2'000;           ///< bearings of an image
  std::size_t pieces = 200;               ///< pieces of a map or path message
  std::size_t picture_bytes = 4'000'000;  ///< size of a JPEG image
  std::size_t text_bytes = 500;           ///< length of a sentence or name
  std::size_t journal_lines = 60;         ///< journal lines stored for clients that connect later
};

/// The newest JPEG image.
struct ShownPicture {
  std::uint64_t number = 0;  ///< counts from 1; 0: no picture
  std::shared_ptr<const std::string> jpeg;
};

/// Number and stamp of a message, which distinguish sessions of the daemon: both increase from one message of a kind to
/// the next.
struct SessionMark {
  std::int64_t number = 0, stamp_us = 0;
};

/// Takes valid messages of one daemon. Its memory is bounded by ViewLimits for any input.
///
/// Events are limited to 30 poses and 15 images per second. A newer event replaces a waiting one of its kind.
///
/// Thread contract: thread-bound.
class LiveView {
 public:
  using Clock = std::chrono::steady_clock;
  using Json = nlohmann::json;

  /// `version` and `source` are sent to each client that connects. Borrows the lookers.
  LiveView(std::string version, std::string source, Lookers& lookers, Clock::time_point now,
           const ViewLimits& limits = {});

  void take_pose(const pose_cov_t& pose, const Reception& heard);
  void take_odometry() { measured_.odometry(); }
  void take_bearings(BearingSet set, const Reception& heard);
  void take_sightings(const sightings_t& sightings, const Reception& heard);
  void take_expectations(const expectations_t& expectations, const Reception& heard);
  void take_map(const map_chunk_t& piece, const Reception& heard);
  void take_path(const path_t& piece, const Reception& heard);
  /// The content is sent with the next status.
  void take_kept(const kept_t& kept, const Reception& heard);
  void take_status(const status_t& status, const Reception& heard);
  void take_truth(const TruthPose& truth, const Reception& heard);
  void take_picture(Stamp stamp, Bytes jpeg, int width_px, int height_px, const Reception& heard);
  /// Takes the text of a rig.toml. An unreadable one counts as none.
  void take_rig(std::string_view toml, const Reception& heard);
  /// Handles a restart of the daemon.
  void restart(const Reception& heard);

  /// Sends due events. `trouble`: reason why no messages can be received; empty if there is none.
  void turn(const Reception& now, const std::string& trouble);
  /// The latest time for the next call of turn() if no message arrives.
  Clock::time_point next_turn() const;

  // For clients that connect, or that must start again because the generation, and with it hello(), has changed.
  std::uint64_t generation() const { return generation_; }
  std::uint64_t restarts() const { return restarts_; }  ///< number of restarts of the daemon
  ViewEvent hello();
  /// An event with trail points newer than `t_s`, which is set to the time of the last one; nothing if there are none.
  std::optional<ViewEvent> trail_after(double& t_s);
  std::optional<ViewEvent> truth_trail_after(double& t_s);
  ViewEvent restarted() { return events_.made(EventKind::restarted, Json::object()); }
  /// The newest events of all other kinds, in the order of sending.
  std::vector<ViewEvent> newest() const { return events_.newest(); }

  const ShownPicture& picture() const { return picture_; }
  Clock::time_point since() const { return since_; }
  const ViewLimits& limits() const { return limits_; }

 private:
  /// Marks of the newest message of each kind. A step may be older than a prediction that was sent before it.
  struct Marks {
    std::optional<SessionMark> step, prediction, status;
  };
  bool takes(std::optional<SessionMark> Marks::*kind, const SessionMark& mark, const Reception& heard);
  void hear(const Reception& heard);
  void begin_at(std::int64_t utime_us);
  double t_s(std::int64_t utime_us) const;
  void send_pose(const Reception& now);
  void send_truth(const Reception& now);
  void send_bearings_if_due(const Reception& now);
  void tell(const News& news, const Reception& now);
  void tell_silence(const Reception& now, const std::string& trouble);
  template <class Piece>
  bool is_bounded(const Piece& piece) const;

  std::string version_, source_;
  ViewLimits limits_;
  Clock::time_point since_;
  std::uint64_t generation_ = 1, restarts_ = 0;
  std::optional<std::int64_t> epoch_us_;
  Json rig_ = nullptr;
  std::string rig_toml_;

  ToldEvents events_;
  SilenceWatch silence_;
  Measured measured_;
  StatusNews news_;

  Trail trail_, truth_trail_;
  ShownMap map_;
  ShownBearings bearings_;
  PathPieces path_;
  ShownPicture picture_;
  Paced<pose_cov_t> pose_;
  Paced<TruthPose> truth_;
  std::optional<kept_t> kept_;
  Marks marks_;
};

}  // namespace azimuth
