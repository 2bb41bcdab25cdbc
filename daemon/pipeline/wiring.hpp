#pragma once
// All wires of the pipeline, with the doorbells they ring: the only memory that two of its threads share. The diagram
// in pipeline.hpp says which is which, and what happens where the reader is slow.

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/end_mark.hpp"
#include "daemon/pipeline/log_wires.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/storage.hpp"
#include "daemon/pipeline/wires.hpp"
#include "daemon/publish/painter.hpp"
#include "daemon/publish/status.hpp"
#include "slam/estimator/estimate.hpp"
#include "slam/sample/map_snapshot.hpp"
#include "slam/sample/odometry_since.hpp"

namespace azimuth {

/// One for each thread.
struct Doorbells {
  explicit Doorbells(Doorbell& of_supervisor) : supervisor(of_supervisor) {}

  std::array<Doorbell, kMaxSources> sources;
  Doorbell perception, estimator, publisher, painter, recorder, frame_recorder, keeper;
  Doorbell& supervisor;
};

/// For the recorders.
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
  Newest<std::string> session;  ///< that images are to be recorded beside
  PosesOut poses_out;
};

/// For people.
struct PictureWires {
  explicit PictureWires(Doorbells& bells) : seen(bells.painter), expected(bells.painter) {}

  Newest<SeenImage> seen;
  Newest<ExpectedImage> expected;
  std::atomic<Stamp> shown{Stamp::min()};  ///< of the image that is to be painted next
};

/// For the next start.
struct KeepWires {
  explicit KeepWires(Doorbells& bells)
      : storage(bells.estimator), maps(bells.keeper), memories(bells.keeper), ways(bells.keeper) {}

  Newest<std::unique_ptr<MapSnapshot>> storage, maps;
  Newest<OdometerMemory> memories;
  Newest<OdometryWays> ways;
};

/// For those who know where the robot has been.
struct PathWires {
  explicit PathWires(Doorbells& bells) : storage(bells.estimator), paths(bells.publisher) {}

  Newest<PathStorage> storage, paths;
};

/// How each part is, for the status.
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

/// What nothing more will come of.
struct EndMarks {
  explicit EndMarks(Doorbells& bells)
      : sources(bells.perception), samples(bells.estimator), estimates(bells.publisher), everything(bells.supervisor) {}

  EndMark sources;  ///< only where there is perception; else a source's end is that of the samples
  EndMark samples, estimates;
  EndMark everything;  ///< all is published
};

/// Only a played source, which is alone, and perception wait for room.
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
  BearingsWire bearings;  ///< from perception if there is one, else from a source
  OdometryWire odometry_echo;
  BearingsWire bearings_echo;
  // What becomes of them
  Newest<StepResult> estimates;
  Newest<Estimate> predictions;
  Newest<SampleFinding> findings;
  Newest<Status> statuses;
  std::array<Newest<DeviceStatus>, kMaxSources> devices;
  std::array<EveryOne<DeviceEvent, 16>, kMaxSources> events;
  Newest<DeviceEvent> start_news;  ///< whether the odometry goes on
  // Beside the way of the samples
  RecordWires record;
  PictureWires pictures;
  KeepWires keep;
  PathWires path;
  PartWires parts;
  EndMarks over;

  /// Gives every slot the storage it will need. Only before the threads start.
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
