#pragma once
// What the pipeline does for people and for later, on threads that nobody waits for: painting, recording, keeping maps.
// A disk that hangs must not end the daemon, so these are not watched.

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
#include "slam/sample/odometry_since.hpp"

namespace azimuth {

class Source;

/// Paints images beside what was expected of them. Thread contract: thread-bound.
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

/// Says how a log is. Thread contract: thread-bound.
class LogReport {
 public:
  explicit LogReport(Newest<RecordStatus>& wire) : wire_(wire) {}

  /// Only what changed, and once a second how large it is: the publisher need not wake up for the rest.
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
    Newest<std::string>* session;  ///< null: no images are recorded
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

/// Records images, each once its pose is out: that has been in more of a hurry. One whose pose does not come, as there
/// is no odometry or others have taken its place, waits a moment only, and less when more are behind it.
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

/// Keeps the map, and how the robot went since. Thread contract: thread-bound; save_last() while all threads are at
/// rest.
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

  /// What the estimator and the odometer know at the end. Once.
  void save_last(EstimatorStage& estimator, Source& odometer);

 private:
  void leave_odometry(OdometryKeeper& odometry, EstimatorStage& estimator, Source& odometer);
  void report();

  MapKeeper& keeper_;
  Wires wires_;
  Doorbell& bell_;
  // Here, at the estimator's, or on its way: so no map is made while one is being saved.
  std::unique_ptr<MapSnapshot> map_ = std::make_unique<MapSnapshot>();
  OdometerMemory memory_;
  OdometryWays ways_;
  MapStatus last_;
  bool saved_last_ = false;
};

}  // namespace azimuth
