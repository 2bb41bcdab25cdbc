#pragma once
// Turns of the threads that serve people and the next start: painting, recording, and saving maps. No other thread
// waits for them. The supervisor does not watch their deadlines, because a hanging disk must not end the daemon.

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "daemon/keep/map_keeper.hpp"
#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/log_wires.hpp"
#include "daemon/pipeline/wires.hpp"
#include "daemon/publish/painter.hpp"
#include "daemon/publish/status.hpp"
#include "daemon/record/recorder.hpp"
#include "drivers/device/odometer_memory.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/sample/map_snapshot.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

class Source;

/// Paints each camera image beside the bearings that the estimator expected in it. Thread contract: thread-bound.
class PainterTurn {
 public:
  struct Wires {
    Newest<SeenImage>& seen_images;
    Newest<ExpectedImage>& expected_images;
  };

  PainterTurn(Painter& painter, Wires wires, Doorbell& bell) : painter_(painter), wires_(wires), bell_(bell) {}

  void operator()();

 private:
  Painter& painter_;
  Wires wires_;
  Doorbell& bell_;
  SeenImage image_;
  ExpectedImage expected_;
  bool has_image_ = false;
  std::chrono::steady_clock::time_point waits_until_{};
};

/// Reports the state of a log to the publisher. Thread contract: thread-bound.
class LogReport {
 public:
  explicit LogReport(Newest<RecordStatus>& wire) : wire_(wire) {}

  /// Publishes the status when its text or its count of lost events has changed, and at most once a second when only
  /// the size of the log has grown. The publisher need not wake up more often.
  void tell(const RecorderStatus& status, Recorder::Clock::time_point now);

 private:
  Newest<RecordStatus>& wire_;
  RecordStatus last_;
  Recorder::Clock::time_point next_{};
};

/// Records samples and messages. Thread contract: thread-bound.
class RecorderTurn {
 public:
  struct Wires {
    TakenWire& taken;
    SentWire& sent;
    Newest<RecordStatus>& status;
    /// Tells the frame recorder which session its images belong to; null: no images are recorded.
    Newest<std::string>* session;
  };

  RecorderTurn(Recorder& recorder, Wires wires, Doorbell& bell);

  void operator()();

 private:
  void tell_session();

  Recorder& recorder_;
  Wires wires_;
  Doorbell& bell_;
  TakenSample taken_;
  SentMessage sent_;
  LogReport report_;
  bool session_told_;
};

/// Records images, each after the estimator has published the pose at its stamp, because the pose has priority. When no
/// pose comes (there is no odometry, or a newer estimate replaced this one), an image waits 50 ms at most. An image
/// does not wait at all when half the ring behind it is full.
///
/// Thread contract: thread-bound.
class FrameRecorderTurn {
 public:
  struct Wires {
    ImagesWire& images;
    Newest<std::string>& session;
    const PosesOut& poses_out;
    Newest<RecordStatus>& status;
  };

  FrameRecorderTurn(FrameRecorder& recorder, Wires wires, Doorbell& bell)
      : recorder_(recorder), wires_(wires), bell_(bell), report_(wires.status) {}

  void operator()();

 private:
  bool take_image();
  bool has_waited() const;

  FrameRecorder& recorder_;
  Wires wires_;
  Doorbell& bell_;
  KeptImage image_;
  bool has_image_ = false;
  std::chrono::steady_clock::time_point waits_until_{};
  std::string session_;
  LogReport report_;
};

/// Saves the map, and keeps the motion of the robot since that map. Thread contract: thread-bound; save_last() only
/// while all threads are at rest.
class KeeperTurn {
 public:
  struct Wires {
    Newest<std::unique_ptr<MapSnapshot>>&maps, &map_storage;
    Newest<OdometerMemory>& memories;
    Newest<OdometryWays>& ways;
    Newest<MapStatus>& status;
  };

  KeeperTurn(MapKeeper& keeper, Wires wires, Doorbell& bell) : keeper_(keeper), wires_(wires), bell_(bell) {}

  void operator()();

  /// Saves the last map of the estimator and the last odometry of the odometer. Only the first call has an effect.
  void save_last(EstimatorStage& estimator, Source& odometer);

 private:
  void leave_odometry(OdometryKeeper& odometry, EstimatorStage& estimator, Source& odometer);
  void report();

  MapKeeper& keeper_;
  Wires wires_;
  Doorbell& bell_;
  // The storage for a map is either here, with the estimator, or on a wire. So no map is made while another is being
  // saved.
  std::unique_ptr<MapSnapshot> map_ = std::make_unique<MapSnapshot>();
  OdometerMemory memory_;
  OdometryWays ways_;
  MapStatus last_;
  bool saved_last_ = false;
};

}  // namespace azimuth
