#pragma once
// What a running daemon says, as what is shown of it: the state that one who begins to look is told, and events for
// those who look already.

#include <azimuth/expectations_t.hpp>
#include <azimuth/kept_t.hpp>
#include <azimuth/map_chunk_t.hpp>
#include <azimuth/path_t.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <azimuth/sightings_t.hpp>
#include <azimuth/status_t.hpp>
#include <chrono>
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
#include "tools/view/heard.hpp"
#include "tools/view/lookers.hpp"
#include "tools/view/measured.hpp"
#include "tools/view/news.hpp"
#include "tools/view/pace.hpp"
#include "tools/view/shown_bearings.hpp"
#include "tools/view/shown_map.hpp"
#include "tools/view/silence_watch.hpp"
#include "tools/view/told_events.hpp"
#include "tools/view/trail.hpp"
#include "tools/view/view_limits.hpp"

namespace azimuth {

/// The newest JPEG.
struct ShownPicture {
  std::uint64_t number = 0;  ///< counts from 1; 0: there is none
  std::shared_ptr<const std::string> jpeg;
};

/// What tells one session's messages from another's: both ascend from one message of a kind to the next.
struct SessionMark {
  std::int64_t number = 0, stamp_us = 0;
};

/// Takes sound messages of one daemon. Bounded by its limits whatever comes.
///
/// Events are at most 30 poses and 15 images a second; a newer one takes the place of one that waits for its turn.
///
/// Thread contract: thread-bound.
class LiveView {
 public:
  using Clock = std::chrono::steady_clock;
  using Json = nlohmann::json;

  /// `version` and `source` are said to who begins to look. Borrows the lookers.
  LiveView(std::string version, std::string source, Lookers& lookers, Clock::time_point now,
           const ViewLimits& limits = {});

  void take_pose(const pose_cov_t& pose, const Heard& heard);
  void take_odometry() { measured_.odometry(); }
  void take_bearings(BearingSet set, const Heard& heard);
  void take_sightings(const sightings_t& sightings, const Heard& heard);
  void take_expectations(const expectations_t& expectations, const Heard& heard);
  void take_map(const map_chunk_t& piece, const Heard& heard);
  void take_path(const path_t& piece, const Heard& heard);
  /// Shown with the next status.
  void take_kept(const kept_t& kept, const Heard& heard);
  void take_status(const status_t& status, const Heard& heard);
  void take_truth(const TruthPose& truth, const Heard& heard);
  void take_picture(Stamp stamp, Bytes jpeg, int width_px, int height_px, const Heard& heard);
  /// The text of a rig.toml; one that cannot be read is none.
  void take_rig(std::string_view toml, const Heard& heard);
  /// The daemon is another one than before.
  void restart(const Heard& heard);

  /// Sends what is due by now. `trouble`: why nothing can be heard at all; empty: nothing is.
  void turn(const Heard& now, const std::string& trouble);
  /// When turn() is wanted although nothing comes.
  Clock::time_point next_turn() const;

  // For one who begins to look, or has to begin anew because the generation is another one: hello() says something
  // else.
  std::uint64_t generation() const { return generation_; }
  std::uint64_t restarts() const { return restarts_; }  ///< of the daemon
  ViewEvent hello();
  /// Points of the way that are newer, in one event; nothing: there are none. Sets `t_s` to the last one's.
  std::optional<ViewEvent> trail_after(double& t_s);
  std::optional<ViewEvent> truth_trail_after(double& t_s);
  ViewEvent restarted() { return events_.made(EventKind::restarted, Json::object()); }
  /// The newest of all else, in the order in which to tell them.
  std::vector<ViewEvent> newest() const { return events_.newest(); }

  const ShownPicture& picture() const { return picture_; }
  Clock::time_point since() const { return since_; }
  const ViewLimits& limits() const { return limits_; }

 private:
  /// Of the newest message of each kind. A step may be older than the prediction sent before it.
  struct Marks {
    std::optional<SessionMark> step, prediction, status;
  };
  bool takes(std::optional<SessionMark> Marks::*kind, const SessionMark& mark, const Heard& heard);
  void hear(const Heard& heard);
  void begin_at(std::int64_t utime_us);
  double t_s(std::int64_t utime_us) const;
  void send_pose(const Heard& now);
  void send_truth(const Heard& now);
  void send_bearings_if_due(const Heard& now);
  void tell(const News& news, const Heard& now);
  void tell_silence(const Heard& now, const std::string& trouble);
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
