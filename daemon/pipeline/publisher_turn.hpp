#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <string>

#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/log_wires.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/storage.hpp"
#include "daemon/pipeline/wires.hpp"
#include "daemon/publish/publisher.hpp"
#include "daemon/publish/status.hpp"

namespace azimuth {

/// The turn of the publisher's thread: it takes estimates and sample echoes and sends messages. It also assembles the
/// status from the reports of all other threads.
///
/// Thread contract: thread-bound.
class PublisherTurn {
 public:
  struct Wires {
    Newest<StepResult>& estimates;
    Newest<Estimate>& predictions;
    OdometryWire& odometry_echo;
    BearingsWire& bearings_echo;
    std::array<Newest<DeviceStatus>, kMaxSources>& devices;
    Newest<PerceptionStatus>& perception;
    Newest<RecordStatus>&record, &frame_record;
    Newest<MapStatus>& map;
    Newest<ProcessStatus>& process;
    Newest<SampleFinding>& findings;
    SentWire* sent;       ///< null: nothing is recorded
    PosesOut* poses_out;  ///< null: no frame recorder waits for poses
    Newest<PathStorage>&path_storage, &paths;
    Newest<Status>& statuses;
    EndMark &estimates_over, &published_all;
  };

  /// `losses` must be callable from any thread. `picture_trouble` goes into the status.
  PublisherTurn(Publisher publisher, Wires wires, Doorbell& bell, std::function<WireLosses()> losses,
                std::string picture_trouble);
  PublisherTurn(const PublisherTurn&) = delete;
  PublisherTurn& operator=(const PublisherTurn&) = delete;

  void operator()();

 private:
  void step();
  void predict();
  void drain_echoes();
  void gather_devices();
  void gather();
  void ask_for_path(Publisher::Clock::time_point now);

  Publisher publisher_;
  Wires wires_;
  Doorbell& bell_;
  std::function<WireLosses()> losses_;
  StepResult result_;
  Estimate prediction_;
  OdometryReading reading_;
  BearingSet set_;
  SentMessage sent_;
  std::array<Publisher::Clock::time_point, kMaxSources> worked_;  // when each source's device last worked
  // The storage for the path is either here, with the estimator, or on a wire.
  PathStorage path_ = std::make_unique<std::vector<PathPose>>();
  Status known_;   // the newest report of every other thread
  Status status_;  // a copy of known_ that is swapped into the wire
};

}  // namespace azimuth
