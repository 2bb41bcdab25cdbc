#pragma once
#include <atomic>
#include <memory>
#include <optional>

#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/log_wires.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/storage.hpp"
#include "daemon/pipeline/wires.hpp"
#include "daemon/publish/painter.hpp"
#include "daemon/publish/status.hpp"
#include "slam/estimator/estimate_digest.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/sample/map_snapshot.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

/// The turn of the estimator's thread: it takes samples in the order of their stamps, and publishes estimates and
/// copies of the samples that the estimator took.
///
/// Thread contract: thread-bound; stage() and digest() only while the thread is at rest.
class EstimatorTurn {
 public:
  struct Wires {
    OdometryWire& odometry;
    BearingsWire& bearings;
    Newest<StepResult>& estimates;
    Newest<Estimate>& predictions;
    Newest<SampleFinding>& findings;
    Newest<DeviceEvent>& start_news;
    EndMark &samples_over, &estimates_over;
    // The pointers below are null where no thread reads the wire.
    OdometryWire* odometry_echo;
    BearingsWire* bearings_echo;
    TakenWire* taken;
    Newest<ExpectedImage>* expected_images;
    std::atomic<Stamp>& shown;
    Newest<std::unique_ptr<MapSnapshot>>&map_storage, &maps;
    Newest<OdometryWays>* ways;
    Newest<PathStorage>&path_storage, &paths;
  };

  EstimatorTurn(EstimatorStage stage, Wires wires, Doorbell& bell);
  EstimatorTurn(const EstimatorTurn&) = delete;
  EstimatorTurn& operator=(const EstimatorTurn&) = delete;

  void operator()();

  EstimatorStage& stage() { return stage_; }
  const EstimatorStage& stage() const { return stage_; }
  /// The digest of the estimates of all steps.
  const EstimateDigest& digest() const { return digest_; }

 private:
  bool advance();
  void drain_samples(bool over);
  void look_for_samples();
  void pass_on(const OdometryReading& reading);
  void pass_on(const BearingSet& set);
  void look_on(const BearingSet& set, const Estimator& estimator);
  void hand_over_map();
  void hand_over_way();
  void hand_over_path();
  void tell_of_start();
  void tell_of_samples(bool over);

  /// True: the expected bearings are published beside each estimate. They are published when sample echoes are, because
  /// both serve viewers that show more than poses.
  bool tells_expectations() const { return wires_.bearings_echo != nullptr; }

  EstimatorStage stage_;
  Wires wires_;
  Doorbell& bell_;
  OdometryReading reading_;
  BearingSet set_, echo_;
  // Whether reading_ and set_ hold a sample that the stage has not taken yet.
  bool has_reading_ = false, has_set_ = false;
  TakenSample taken_;
  ExpectedImage expected_;
  // Identifiers of the landmarks in the map, for ExpectedImage::in_map; filled only when pictures are painted.
  std::vector<std::int64_t> in_map_;
  StepResult result_;
  Estimate prediction_;
  EstimateDigest digest_;
  std::unique_ptr<MapSnapshot> map_;
  OdometryWays ways_;
  PathStorage path_;
  Stamp next_way_ = Stamp::min(), next_expected_ = Stamp::min();
  SampleTrouble told_trouble_ = SampleTrouble::none;
  SampleFinding finding_;
  bool told_of_start_ = false;
};

}  // namespace azimuth
