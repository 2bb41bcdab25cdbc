#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <string>

#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/end_mark.hpp"
#include "daemon/pipeline/log_wires.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/storage.hpp"
#include "daemon/pipeline/wires.hpp"
#include "daemon/publish/publisher.hpp"
#include "daemon/publish/status.hpp"

namespace azimuth {

/// What the publisher's thread does: estimates and echoes in, messages out; and it puts together what every other
/// thread says of itself.
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
    SentWire* sent;       ///< null: nobody records
    PosesOut* poses_out;  ///< null: nobody waits for them
    Newest<PathStorage>&path_storage, &paths;
    Newest<Status>& statuses;
    EndMark &estimates_over, &published_all;
  };

  /// `losses` may be asked by any thread. `picture_trouble` is for the status.
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
  std::array<Publisher::Clock::time_point, kMaxSources> worked_;  // the devices, last
  // Here, at the estimator's, or on its way.
  PathStorage path_ = std::make_unique<std::vector<PathPose>>();
  Status known_;   // of what others said last
  Status status_;  // storage of it goes round
};

}  // namespace azimuth
