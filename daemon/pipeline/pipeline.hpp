#pragma once
/*  The whole daemon at a glance. Data flows from left to right; every arrow is one wire below.
 *
 *   source(s) ──frames──▶ perception ──bearings──▶ estimator ──estimates────▶ publisher ──▶ LCM
 *     │ ├────────────odometry───────────────────────▶ │ └───────predictions──▶   ▲  │  └──status──▶ supervisor
 *     │ └────(or ready-made bearings)───────────────▶ ├─samples taken (echoes)───┤  └─messages sent─▶ recorder ──▶ log
 *     │                    │                          └─samples taken────────────┼────────────────────▶  │
 *     ├─device status──────┴─perception status───────────────────────────────────┴─────record status─────┘
 *     └─device events──▶ supervisor ◀──whether the odometry goes on── estimator
 *
 *   perception ──images looked at──▶ frame recorder ──▶ its own log      when images are to be recorded
 *   estimator ──maps──▶ keeper ──▶ map file       now and then; each map goes in storage that the keeper sent before
 *   estimator ──paths──▶ publisher                now and then, in storage that the publisher sent before; it sends
 * those that have moved source ──odometer memory──▶ keeper ◀──way since the map── estimator      for the next start,
 * which goes on with it perception ──images seen──▶ painter ◀──what was expected of them── estimator      now and then,
 * for people
 *
 *   wire         kind      when the reader is slow
 *   frames       Newest    the unread one is replaced, its lease returned at once; a played source waits until each has
 *                          been looked at, so none is
 *   odometry     EveryOne  a played source waits for room; a live one is refused and counted (readings are cumulative)
 *   bearings     EveryOne  likewise; perception takes no frame while there is no room, so the oldest frames go first
 *   echoes       EveryOne  refused and counted: nobody waits for the network
 *   to recorder  EveryOne  refused and counted: nobody waits for the disk
 *   images kept  EveryOne  refused and counted; copies, so that the camera has its buffers back whatever the disk does
 *   estimates    Newest    the unread one is replaced (the map in the next one is the better one)
 *   predictions  Newest    likewise
 *   findings     Newest    likewise: of samples that cannot be right, from estimator to publisher when that changes
 *   to painter   Newest    likewise
 *   maps         Newest    none is made while the one before is being saved
 *   paths        Newest    none is made while the one before is being sent
 *   to go on     Newest    the unread one is replaced
 *   statuses     Newest    likewise
 *   events       EveryOne  refused: the next status says how the device is
 *
 * End of a recording: the source says that nothing more will come, perception looks at the last frame and says so too,
 * the estimator drains, decides what still waits and says that no estimate will come, the publisher drains and sends
 * the last map and status. A stop is the same, early; the recorder is stopped last.
 */

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "daemon/keep/map_keeper.hpp"
#include "daemon/pipeline/background_turns.hpp"
#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/estimator_turn.hpp"
#include "daemon/pipeline/perception_stage.hpp"
#include "daemon/pipeline/perception_turn.hpp"
#include "daemon/pipeline/publisher_turn.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/source_turn.hpp"
#include "daemon/pipeline/stage_thread.hpp"
#include "daemon/pipeline/thread_settings.hpp"
#include "daemon/pipeline/wiring.hpp"
#include "daemon/publish/painter.hpp"
#include "daemon/publish/publisher.hpp"
#include "daemon/record/frame_recorder.hpp"
#include "daemon/record/recorder.hpp"
#include "slam/estimator/estimate_digest.hpp"
#include "slam/estimator/estimator_stage.hpp"

namespace azimuth {

/// What the threads run. Each is touched by exactly one of them.
struct Stages {
  std::vector<std::unique_ptr<Source>> sources;    ///< one or two; the odometer's before the camera's
  std::optional<PerceptionStage> perception = {};  ///< none: bearings come ready made
  EstimatorStage estimator;
  Publisher publisher;
  bool echo_samples = true;
  std::optional<Painter> painter = {};  ///< only with perception
  std::optional<Recorder> recorder = {};
  std::optional<FrameRecorder> frame_recorder = {};  ///< only beside a recorder, and with perception
  std::optional<MapKeeper> keeper = {};
  std::string picture_trouble = {};  ///< for the status
};

/// Doorbells, wires, and the threads that take turns at the stages.
///
/// Thread contract: everything public belongs to one thread, the supervisor's.
class Pipeline {
 public:
  /// `supervisor` rings for every status and device event, and when the recording has been played to its end.
  Pipeline(Stages stages, const ThreadSettings& threads, Doorbell& supervisor);
  ~Pipeline() { stop(); }
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  void start();  ///< readers before writers; once
  void stop();   ///< writers before readers; each reader drains, then ends

  /// The whole recording has been played, estimated and published.
  bool finished() const { return wires_.over.everything.is_set(); }
  /// The newest status, if there is an unread one.
  bool take_status(Status& into) { return wires_.statuses.take(into); }
  /// The next thing that happened to a device.
  bool take_event(DeviceEvent& into);
  /// How the process is, for the status.
  void tell(ProcessStatus process) { wires_.parts.process.publish(process); }
  WireLosses losses() const { return wires_.losses(); }
  /// Of all steps. Only after stop().
  const EstimateDigest& digest() const { return estimator_.digest(); }
  /// The map as it was last. False: there is none that could be started from. Only after stop().
  bool last_map(MapSnapshot& out) const { return estimator_.stage().save_map(out); }

  /// The first stage in flow order that is past its deadline; null: none. Painter, recorders and keeper are not asked:
  /// a disk that hangs must not end the daemon.
  const StageThread* first_late(std::chrono::steady_clock::time_point now) const;
  const std::vector<StageThread*>& threads() const { return flow_; }

 private:
  /// A row of the table of threads.
  struct Thread {
    StageSpec spec;
    bool is_watched;
    Doorbell& bell;
    std::function<void()> turn;
    std::function<void()> when_stopped = [] {};  ///< before those after it are stopped
  };

  std::vector<Thread> table(const ThreadSettings& threads);
  SourceTurn source_turn(std::size_t i);
  EstimatorTurn::Wires estimator_wires();
  PublisherTurn::Wires publisher_wires();
  bool paints() const { return stages_.perception && stages_.painter; }
  bool records_images() const { return stages_.perception && stages_.recorder && stages_.frame_recorder; }

  Doorbells bells_;
  Wiring wires_;
  Stages stages_;

  // What each thread does, and holds in its hands between the wires.
  std::vector<SourceTurn> sources_;
  std::optional<PerceptionTurn> perception_;
  EstimatorTurn estimator_;
  PublisherTurn publisher_;
  std::optional<PainterTurn> painter_;
  std::optional<RecorderTurn> recorder_;
  std::optional<FrameRecorderTurn> frame_recorder_;
  std::optional<KeeperTurn> keeper_;

  // Threads last, so that they end before anything they touch. In flow order.
  std::vector<Thread> table_;
  std::vector<std::unique_ptr<StageThread>> threads_;
  std::vector<StageThread*> flow_;
  bool started_ = false, stopped_ = false;
};

}  // namespace azimuth
