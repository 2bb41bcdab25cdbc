#pragma once
// All wires of the pipeline, with the doorbells that they ring. The drawing in pipeline.hpp names the wires and tells
// what happens when a reader is slow.

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/log_wires.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/storage.hpp"
#include "daemon/pipeline/wires.hpp"
#include "daemon/publish/painter.hpp"
#include "daemon/publish/status.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/sample/map_snapshot.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// One doorbell for each thread.
struct Doorbells {
  explicit Doorbells(Doorbell& of_supervisor) : supervisor(of_supervisor) {}

  std::array<Doorbell, kMaxSources> sources;
  Doorbell perception, estimator, publisher, painter, recorder, frame_recorder, keeper;
  Doorbell& supervisor;
};

/// The wires to the recorders.
struct RecordWires {
  explicit RecordWires(Doorbells& bells)
      : taken(bells.recorder),
        sent(bells.recorder),
        images(bells.frame_recorder),
        session(bells.frame_recorder),
        poses_out(bells.frame_recorder) {}

  TakenWire taken;
  SentWire sent;
  ImagesWire images;
  Newest<std::string> session;  ///< name of the session beside which images are recorded
  PosesOut poses_out;
};

/// The wires to the painter.
struct PictureWires {
  explicit PictureWires(Doorbells& bells) : seen(bells.painter), expected(bells.painter) {}

  Newest<SeenImage> seen;
  Newest<ExpectedImage> expected;
  std::atomic<Stamp> shown{Stamp::min()};  ///< stamp of the image that is painted next
};

/// The wires to the keeper, which saves data for the next start.
struct KeepWires {
  explicit KeepWires(Doorbells& bells)
      : storage(bells.estimator), maps(bells.keeper), memories(bells.keeper), ways(bells.keeper) {}

  Newest<std::unique_ptr<MapSnapshot>> storage, maps;
  Newest<OdometerMemory> memories;
  Newest<OdometryWays> ways;
};

/// The wires for the path of the robot: requests (empty storage) and paths.
struct PathWires {
  explicit PathWires(Doorbells& bells) : storage(bells.estimator), paths(bells.publisher) {}

  Newest<PathStorage> storage, paths;
};

/// The wires on which each part reports its state, for the status.
struct PartWires {
  explicit PartWires(Doorbells& bells)
      : perception(bells.publisher),
        record(bells.publisher),
        frame_record(bells.publisher),
        map(bells.publisher),
        process(bells.publisher) {}

  Newest<PerceptionStatus> perception;
  Newest<RecordStatus> record, frame_record;
  Newest<MapStatus> map;
  Newest<ProcessStatus> process;
};

/// The end marks, in the order in which they are set.
struct EndMarks {
  explicit EndMarks(Doorbells& bells)
      : sources(bells.perception), samples(bells.estimator), estimates(bells.publisher), everything(bells.supervisor) {}

  /// Set when the sources end. Used only with perception; otherwise the end of a source sets `samples`.
  EndMark sources;
  EndMark samples, estimates;
  EndMark everything;  ///< set when everything has been published
};

/// Only perception and a played source wait for room. A played source is the only source.
struct Wiring {
  Wiring(Doorbells& bells, bool with_perception)
      : frames(bells.perception),
        odometry(bells.estimator, &bells.sources[0]),
        bearings(bells.estimator, with_perception ? &bells.perception : &bells.sources[0]),
        odometry_echo(bells.publisher),
        bearings_echo(bells.publisher),
        estimates(bells.publisher),
        predictions(bells.publisher),
        findings(bells.publisher),
        statuses(bells.supervisor),
        devices{Newest<DeviceStatus>(bells.publisher), Newest<DeviceStatus>(bells.publisher)},
        events{EveryOne<DeviceEvent, 16>(bells.supervisor), EveryOne<DeviceEvent, 16>(bells.supervisor)},
        start_news(bells.supervisor),
        record(bells),
        pictures(bells),
        keep(bells),
        path(bells),
        parts(bells),
        over(bells) {}

  // Samples
  FramesWire frames;
  OdometryWire odometry;
  BearingsWire bearings;  ///< from perception if there is one, otherwise from a source
  OdometryWire odometry_echo;
  BearingsWire bearings_echo;
  // Results
  Newest<StepResult> estimates;
  Newest<Estimate> predictions;
  Newest<SampleFinding> findings;
  Newest<Status> statuses;
  std::array<Newest<DeviceStatus>, kMaxSources> devices;
  std::array<EveryOne<DeviceEvent, 16>, kMaxSources> events;
  Newest<DeviceEvent> start_news;  ///< whether the odometry continues from before the start
  // Other wires
  RecordWires record;
  PictureWires pictures;
  KeepWires keep;
  PathWires path;
  PartWires parts;
  EndMarks over;

  /// Reserves the storage of every slot. Only before the threads start.
  void prepare() {
    const auto grow = [](auto& value) { azimuth::prepare(value); };
    bearings.prepare(grow);
    bearings_echo.prepare(grow);
    record.taken.prepare([](TakenSample& sample) { azimuth::prepare(sample.bearings); });
    estimates.prepare(grow);
    predictions.prepare(grow);
  }

  WireLosses losses() const {
    return {.odometry_refused = odometry.refused(),
            .bearings_refused = bearings.refused(),
            .frames_replaced = frames.replaced(),
            .estimates_replaced = estimates.replaced(),
            .echoes_refused = odometry_echo.refused() + bearings_echo.refused(),
            .records_refused = record.taken.refused() + record.sent.refused() + record.images.refused()};
  }
};

}  // namespace azimuth
