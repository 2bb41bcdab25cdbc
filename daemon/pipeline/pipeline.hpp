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
 *   source ──odometer memory──▶ keeper ◀──way since the map── estimator      for the next start, which goes on with it
 *   perception ──images seen──▶ painter ◀──what was expected of them── estimator      now and then, for people
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
 *   to go on     Newest    the unread one is replaced
 *   statuses     Newest    likewise
 *   events       EveryOne  refused: the next status says how the device is
 *
 * End of a recording: the source says that nothing more will come, perception looks at the last frame and says so too,
 * the estimator drains, decides what still waits and says that no estimate will come, the publisher drains and sends
 * the last map and status. A stop is the same, early; the recorder is stopped last.
 */

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "daemon/keep/map_keeper.hpp"
#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/perception_stage.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/stage_thread.hpp"
#include "daemon/pipeline/thread_settings.hpp"
#include "daemon/pipeline/wires.hpp"
#include "daemon/publish/painter.hpp"
#include "daemon/publish/publisher.hpp"
#include "daemon/record/frame_pace.hpp"
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
  std::optional<Painter> painter = {};
  std::optional<Recorder> recorder = {};
  std::optional<FrameRecorder> frame_recorder = {};  ///< only beside a recorder, and with perception
  std::optional<MapKeeper> keeper = {};
  std::string picture_trouble = {};  ///< for the status
};

/// A sample on its way to the recorder, in the order in which the estimator took them.
struct TakenSample {
  bool is_odometry = false;  ///< else bearings
  OdometryReading odometry;
  BearingSet bearings;
};

/// A message on its way to the recorder.
struct SentMessage {
  std::string channel;
  std::vector<std::byte> data;
};

/// Stages, wires and threads.
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
  bool finished() const { return published_all_.load(std::memory_order_acquire); }
  /// The newest status, if there is an unread one.
  bool take_status(Status& into) { return status_.take(into); }
  /// The next thing that happened to a device.
  bool take_event(DeviceEvent& into);
  /// How the process is, for the status.
  void tell(ProcessStatus process) { process_.publish(process); }
  WireLosses losses() const;
  /// Of all steps. Only after stop().
  const EstimateDigest& digest() const { return digest_; }
  /// The map as it was last. False: there is none that could be started from. Only after stop().
  bool last_map(MapSnapshot& out) const { return stages_.estimator.save_map(out); }

  /// The first stage in flow order that is past its deadline; null: none. Painter, recorders and keeper are not asked:
  /// a disk that hangs must not end the daemon.
  const StageThread* first_late(std::chrono::steady_clock::time_point now) const;
  const std::vector<StageThread*>& threads() const { return flow_; }

 private:
  static constexpr std::size_t kMaxSources = 2;
  static constexpr std::size_t kTakenRing = 1024, kSentRing = 256;  ///< seconds of a slow disk
  static constexpr std::size_t kImagesRing = 8;                     ///< megabytes each: half a second of it

  void run_source(std::size_t i);
  void end_of_samples();
  void perceive();
  void estimate();
  void publish();
  void paint();
  void show(const Frame& frame, const BearingSet& seen);
  void show(const BearingSet& set, const Estimator& estimator);
  void keep(const Frame& frame);
  void record();
  void tell_session();
  void record_images();
  void keep();
  void hand_over_map();
  void hand_over_way();
  void tell_of_start();
  void hand_over_memory();
  void save_last_map();
  void leave_odometry();
  void report(const MapKeeperStatus& status);
  static void report(const RecorderStatus& status, RecordStatus& last, Newest<RecordStatus>& wire);
  void drain_samples(bool over);
  void look_for_samples();
  void drain_echoes();
  void tell_of_samples(bool over);
  void pass_on(const OdometryReading& reading);
  void pass_on(const BearingSet& set);
  void prepare_storage();
  void gather(Status& status);

  // 1. Doorbells: one per thread.
  std::array<Doorbell, kMaxSources> source_bells_;
  Doorbell perception_bell_, estimator_bell_, publisher_bell_, painter_bell_, recorder_bell_, frame_recorder_bell_,
      keeper_bell_;
  Doorbell& supervisor_bell_;

  // 2. Wires: the only memory two threads share. Only a played source, which is alone, and perception wait for room.
  FramesWire frames_{perception_bell_};
  OdometryWire odometry_{estimator_bell_, &source_bells_[0]};
  BearingsWire bearings_;  // from perception if there is one, else from a source
  OdometryWire odometry_echo_{publisher_bell_};
  BearingsWire bearings_echo_{publisher_bell_};
  Newest<StepResult> estimates_{publisher_bell_};
  Newest<Estimate> predictions_{publisher_bell_};
  Newest<SampleFinding> samples_{publisher_bell_};
  Newest<Status> status_{supervisor_bell_};
  std::array<Newest<DeviceStatus>, kMaxSources> devices_{Newest<DeviceStatus>(publisher_bell_),
                                                         Newest<DeviceStatus>(publisher_bell_)};
  std::array<EveryOne<DeviceEvent, 16>, kMaxSources> events_{EveryOne<DeviceEvent, 16>(supervisor_bell_),
                                                             EveryOne<DeviceEvent, 16>(supervisor_bell_)};
  EveryOne<TakenSample, kTakenRing> taken_{recorder_bell_};
  EveryOne<SentMessage, kSentRing> sent_{recorder_bell_};
  EveryOne<KeptImage, kImagesRing> kept_images_{frame_recorder_bell_};
  Newest<std::string> session_{frame_recorder_bell_};
  Newest<SeenImage> seen_images_{painter_bell_};
  Newest<ExpectedImage> expected_images_{painter_bell_};
  std::atomic<Stamp> shown_{Stamp::min()};  // of the image that is to be painted next
  Newest<PerceptionStatus> perception_status_{publisher_bell_};
  Newest<RecordStatus> record_status_{publisher_bell_}, frame_record_status_{publisher_bell_};
  Newest<std::unique_ptr<MapSnapshot>> map_storage_{estimator_bell_}, maps_{keeper_bell_};
  Newest<OdometerMemory> memories_{keeper_bell_};
  Newest<std::optional<OdometrySince>> ways_{keeper_bell_};
  Newest<MapStatus> map_status_{publisher_bell_};
  Newest<ProcessStatus> process_{publisher_bell_};
  Newest<DeviceEvent> start_news_{supervisor_bell_};
  std::atomic<bool> sources_over_{false}, samples_over_{false}, estimates_over_{false}, published_all_{false};

  // 3. Stages, and what each thread holds in its hands between the wires.
  Stages stages_;
  Frame perception_frame_;
  BearingSet perception_set_;
  PerceptionStatus perception_news_, publisher_perception_;
  SeenImage perception_image_, painter_image_;
  ExpectedImage estimator_expected_, painter_expected_;
  FramePace frame_pace_;
  KeptImage perception_kept_, frame_recorder_kept_;
  std::string frame_recorder_session_;
  bool session_told_ = false;
  std::chrono::steady_clock::time_point next_picture_{}, painter_waits_until_{};
  bool painter_has_image_ = false;
  OdometryReading estimator_reading_;
  BearingSet estimator_set_, estimator_echo_;
  bool has_reading_ = false, has_set_ = false;  // the estimator, in estimator_reading_ and estimator_set_
  TakenSample estimator_taken_, recorder_taken_;
  SentMessage publisher_sent_, recorder_sent_;
  RecordStatus recorder_status_, frame_recorder_status_, publisher_record_, publisher_frame_record_;
  std::unique_ptr<MapSnapshot> estimator_map_, keeper_map_ = std::make_unique<MapSnapshot>();
  OdometerMemory source_memory_, keeper_memory_;
  std::chrono::steady_clock::time_point next_memory_{};
  std::optional<OdometrySince> estimator_way_, keeper_way_;
  Stamp next_way_ = Stamp::min();
  bool told_of_start_ = false;
  MapStatus keeper_status_, publisher_map_;
  ProcessStatus publisher_process_;
  SampleTrouble told_trouble_ = SampleTrouble::none;
  SampleFinding estimator_samples_, publisher_samples_;
  StepResult result_;
  Estimate prediction_;
  EstimateDigest digest_;
  OdometryReading publisher_reading_;
  BearingSet publisher_set_;
  StepResult publisher_result_;
  Estimate publisher_prediction_;
  std::array<DeviceStatus, kMaxSources> publisher_devices_;
  Status publisher_status_;

  // 4. Threads last, so that they end before anything they touch. In flow order.
  std::vector<std::unique_ptr<StageThread>> sources_;
  std::optional<StageThread> perception_;
  StageThread estimator_, publisher_;
  std::optional<StageThread> painter_, recorder_, frame_recorder_, keeper_;
  std::vector<StageThread*> flow_;
  bool closed_ = false;  // the sources' devices
  bool started_ = false, saved_last_map_ = false;
};

}  // namespace azimuth
