#pragma once
// clang-format off
/*  The whole daemon at a glance. Data flows from left to right; every arrow is one wire of the table below.
 *
 *   source(s) ──frames──▶ perception ──bearings──▶ estimator ──estimates────▶ publisher ──▶ LCM
 *     │ ├────────────odometry───────────────────────▶ │ └───────predictions──▶   ▲  │  └──status──▶ supervisor
 *     │ └────(or ready-made bearings)───────────────▶ ├─samples taken (echoes)───┤  └─messages sent─▶ recorder ──▶ log
 *     │                    │                          └─samples taken────────────┼────────────────────▶  │
 *     ├─device status──────┴─perception status───────────────────────────────────┴─────record status─────┘
 *     └─device events──▶ supervisor ◀──whether the odometry continues from before the start── estimator
 *
 *   perception ──images──▶ frame recorder ──▶ its own log               if images are to be recorded
 *   perception ──images──▶ painter ◀──expected bearings── estimator     now and then, pictures for people
 *   estimator ──maps──▶ keeper ──▶ map file                             now and then, in storage from the keeper
 *   estimator ──paths──▶ publisher                                      now and then, in storage from the publisher
 *   source ──odometer memory──▶ keeper ◀──motion since the map── estimator   for the next start of the daemon
 *
 *   wire             kind      when the reader is slow
 *   frames           Newest    The unread frame is replaced and its lease is returned at once. A played source waits
 *                              until perception has returned each frame, so it loses none.
 *   odometry         EveryOne  A played source waits for room. A reading of a live source is refused and counted;
 *                              readings are cumulative, so no motion is lost.
 *   bearings         EveryOne  Like odometry. Perception takes no frame while there is no room, so newer frames replace
 *                              older ones in the wire before it.
 *   echoes           EveryOne  Refused and counted, because the estimator does not wait for the network.
 *   to recorder      EveryOne  Refused and counted, because no stage waits for the disk.
 *   images recorded  EveryOne  Refused and counted. They are copies, so a slow disk does not keep the camera's buffers.
 *   estimates        Newest    The unread estimate is replaced; the next one has the better map.
 *   predictions      Newest    The unread prediction is replaced.
 *   findings         Newest    The unread finding is replaced. A finding says why samples are wrong; the estimator
 *                              sends it to the publisher when it changes.
 *   to painter       Newest    The unread image, and the unread expected bearings, are replaced.
 *   maps             Newest    No map is made while the previous one is being saved.
 *   paths            Newest    No path is made while the previous one is being sent.
 *   for next start   Newest    The unread odometer memory, and the unread motion, are replaced.
 *   statuses         Newest    The unread status is replaced.
 *   events           EveryOne  Refused; the next status tells the state of the device.
 *
 * At the end of a recording the source sets its end mark. Perception observes the last frame and sets its own mark. The
 * estimator drains its wires, processes the waiting samples and sets its mark. The publisher drains its wires and sends
 * the last map and status. A stop of the daemon runs the same steps early; the recorders are stopped after the
 * publisher.
 */
// clang-format on

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
#include "daemon/pipeline/publisher_turn.hpp"
#include "daemon/pipeline/sample_turns.hpp"
#include "daemon/pipeline/source.hpp"
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

/// The objects that the threads run. Each object is touched by exactly one thread.
struct Stages {
  std::vector<std::unique_ptr<Source>> sources;    ///< one or two; the odometer's source comes before the camera's
  std::optional<PerceptionStage> perception = {};  ///< none: the source sends ready-made bearings
  EstimatorStage estimator;
  Publisher publisher;
  bool echo_samples = true;
  std::optional<Painter> painter = {};  ///< used only with perception
  std::optional<Recorder> recorder = {};
  std::optional<FrameRecorder> frame_recorder = {};  ///< used only together with recorder and perception
  std::optional<MapKeeper> keeper = {};
  std::string picture_trouble = {};  ///< why no pictures can be painted; for the status
};

/// Owns the doorbells, the wires, and the threads that run the turns of the stages.
///
/// Thread contract: all public members belong to one thread, the supervisor's.
class Pipeline {
 public:
  /// `supervisor` rings for every status and every device event, and when the recording has been played to its end.
  Pipeline(Stages stages, const ThreadSettings& threads, Doorbell& supervisor);
  ~Pipeline() { stop(); }
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  void start();  ///< Starts readers before writers. Only once.
  void stop();   ///< Stops writers before readers. Each reader drains its wires, then ends.

  /// True: the whole recording has been played, estimated and published.
  bool finished() const { return wires_.over.everything.is_set(); }
  /// Takes the newest status. False: there is no unread one.
  bool take_status(Status& into) { return wires_.statuses.take(into); }
  /// Takes the next device event, with the source's name. False: there is none.
  bool take_event(DeviceEvent& into);
  /// Passes the state of the process to the publisher, for the status.
  void tell(ProcessStatus process) { wires_.parts.process.publish(process); }
  WireLosses losses() const { return wires_.losses(); }
  /// The digest of the estimates of all steps. Only after stop().
  const EstimateDigest& digest() const { return estimator_.digest(); }
  /// Copies the last map of the estimator. False: there is no map that a start could use. Only after stop().
  bool last_map(MapSnapshot& out) const { return estimator_.stage().save_map(out); }

  /// The first stage, in the order of table(), that has exceeded its deadline; null: none. Painter, recorders and
  /// keeper are not watched, because a hanging disk must not end the daemon.
  const StageThread* first_late(std::chrono::steady_clock::time_point now) const;
  const std::vector<StageThread*>& threads() const { return flow_; }

 private:
  /// A row of the table of threads.
  struct Thread {
    StageSpec spec;
    bool is_watched;
    Doorbell& bell;
    std::function<void()> turn;
    /// Called after this thread has stopped and before the next thread in the table is stopped.
    std::function<void()> when_stopped = [] {};
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

  // The turn of each thread, with the values it holds between reading one wire and writing another.
  std::vector<SourceTurn> sources_;
  std::optional<PerceptionTurn> perception_;
  EstimatorTurn estimator_;
  PublisherTurn publisher_;
  std::optional<PainterTurn> painter_;
  std::optional<RecorderTurn> recorder_;
  std::optional<FrameRecorderTurn> frame_recorder_;
  std::optional<KeeperTurn> keeper_;

  // The threads are declared last, so that they end before the members they use are destroyed.
  std::vector<Thread> table_;
  std::vector<std::unique_ptr<StageThread>> threads_;
  std::vector<StageThread*> flow_;  // in the order of table_
  bool started_ = false, stopped_ = false;
};

}  // namespace azimuth
