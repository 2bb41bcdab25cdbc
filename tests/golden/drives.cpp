#include "tests/golden/drives.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

#include "settings/configured_estimator.hpp"
#include "settings/rig.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/perception/make_perception.hpp"
#include "tests/support/feature_world.hpp"
#include "tests/support/lamp_run.hpp"
#include "tests/support/places.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/replay/set_source.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth::golden {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr Stamp kTaken{std::chrono::seconds(170)}, kPutDown{std::chrono::seconds(193)};

Rig rig_of(const Run& run) { return read_rig(run.rig_toml, run.rig_file).value(); }

std::unique_ptr<Estimator> estimator_of(EstimatorKind kind, const Rig& rig) {
  Configuration configuration;
  configuration.estimator = kind;
  return configured_estimator(rig, configuration);
}

/// Feeds the samples to the stage in the order of a replay. `map` receives the final map.
Trajectory through_the_stage(const Run& run, const Rig& rig, SetSource& sets, std::unique_ptr<Estimator> estimator,
                             MapSnapshot* map = nullptr) {
  EstimatorStage stage(std::move(estimator), rig, {});
  Trajectory trajectory;
  Estimate estimate;
  const auto step = [&] {
    while (stage.advance(estimate)) trajectory.push_back(waypoint(trajectory.size() + 1, estimate));
  };
  auto reading = run.odometry.begin();
  const auto add_odometry_until = [&](Stamp stamp) {
    for (; reading != run.odometry.end() && reading->stamp <= stamp; ++reading) {
      stage.add(*reading);
      step();
    }
  };
  for (BearingSet set; sets.next(set); step()) {
    add_odometry_until(set.stamp);
    stage.add(set);
  }
  add_odometry_until(Stamp::max());
  stage.finish();
  step();
  if (map != nullptr) stage.save_map(*map);
  return trajectory;
}

Trajectory through_the_stage(const Run& run, const Rig& rig) {
  RecordedSets sets(run);
  return through_the_stage(run, rig, sets, estimator_of(EstimatorKind::ekf, rig));
}

/// The shipped run, whose landmarks have identities.
Trajectory lab() {
  const Run run = *load_run(test::source_folder() / "runs/lab");
  return through_the_stage(run, rig_of(run));
}

/// The same run with the smoother. Each pose is the estimate at its own time.
Trajectory smoothed_lab() {
  const Run run = *load_run(test::source_folder() / "runs/lab");
  const Rig rig = rig_of(run);
  RecordedSets sets(run);
  return through_the_stage(run, rig, sets, estimator_of(EstimatorKind::smoother, rig));
}

/// A round of stops a metre apart. Each landmark is mapped only when two of its bearings cross at a sufficient angle.
Trajectory delayed_lab() {
  const Run run = simulated_run(coloured_lab(kSeed));
  const Rig rig = rig_of(run);
  const std::array<std::string, 2> delayed{"estimator=ekf", "ekf.initialisation=delayed"};
  RecordedSets sets(run);
  return through_the_stage(run, rig, sets, configured_estimator(rig, read_configuration("", "", delayed).value()));
}

/// A drive without identities and with clutter, which needs data association.
Trajectory nameless_lab() {
  Scenario scenario = azimuth::lab(kSeed, 2);
  scenario.sensor.identities = false;
  scenario.sensor.clutter_per_set = 0.2;
  const Run run = simulated_run(scenario);
  return through_the_stage(run, rig_of(run));
}

/// Features that differ by their descriptors.
Trajectory features() {
  const FeatureWorld world = feature_world(kSeed);
  Rig rig = rig_of(world.run);
  rig.front_end = FrontEnd::sift;
  rig.camera.identities = false;
  return through_the_stage(world.run, rig);
}

/// Bearings found in images of coloured cylinders, which are rendered here.
Trajectory coloured_images() {
  const test::TemporaryFolder folder;
  const Run run = *rendered_run(coloured_lab(kSeed), {}, folder.path());
  const Rig rig = rig_of(run);
  SeenSets sets(run, rig.camera.image, {make_perception(rig.front_end, rig.camera, {}), decoded_format(rig.front_end)});
  return through_the_stage(run, rig, sets, estimator_of(EstimatorKind::ekf, rig));
}

/// The shipped run on its own saved map, which stays unchanged. The robot has to relocalise first.
Trajectory localised_lab() {
  const Run run = *load_run(test::source_folder() / "runs/lab");
  const Rig rig = rig_of(run);
  MapSnapshot map;
  RecordedSets first(run), second(run);
  through_the_stage(run, rig, first, estimator_of(EstimatorKind::ekf, rig), &map);
  Configuration configuration;
  configuration.estimator = EstimatorKind::ekf;
  configuration.map.mode = MapMode::localise;
  return through_the_stage(run, rig, second, configured_estimator(rig, configuration, &map));
}

/// After two rounds among coloured landmarks the robot is carried by a third of a round. The estimator detects this and
/// relocalises.
Trajectory carried_lab() {
  constexpr int kColours = 4;
  const auto in_hand = [](Stamp stamp) { return stamp >= kTaken && stamp < kPutDown; };
  Run run = simulated_run(azimuth::lab(kSeed, 4));
  std::erase_if(run.odometry, [&](const OdometryReading& reading) { return in_hand(reading.stamp); });
  std::erase_if(run.bearings, [&](const BearingSet& set) { return in_hand(set.stamp); });
  for (BearingSet& set : run.bearings) {
    if (set.stamp >= kPutDown) set.stamp -= kPutDown - kTaken;
    for (Bearing& bearing : set.bearings) {
      bearing.kind = static_cast<Kind>(bearing.identity % kColours);
      bearing.identity = kUnknownIdentity;
    }
  }
  const auto put_down =
      std::ranges::find_if(run.odometry, [](const auto& reading) { return reading.stamp >= kPutDown; });
  const Pose2 T_odom_hidden = (put_down - 1)->T_odom_body * inverse(put_down->T_odom_body);
  for (auto reading = put_down; reading != run.odometry.end(); ++reading) {
    reading->stamp -= kPutDown - kTaken;
    reading->T_odom_body = T_odom_hidden * reading->T_odom_body;
  }
  Rig rig = rig_of(run);
  rig.camera.identities = false;
  return through_the_stage(run, rig);
}

/// Returns the trajectory; `map` receives the final map.
Trajectory below_lamps(const LampRun& run, const std::unique_ptr<Estimator>& estimator, MapSnapshot* map = nullptr) {
  Trajectory trajectory;
  Estimate estimate;
  for (std::size_t i = 0; i < run.sets.size(); ++i) {
    estimator->predict(run.motions[i]);
    estimator->update(run.sets[i]);
    estimate.landmarks.clear();
    estimator->estimate(estimate);
    estimate.stamp = run.sets[i].stamp;
    trajectory.push_back(waypoint(i + 1, estimate));
  }
  if (map != nullptr) estimator->save_map(*map);
  return trajectory;
}

Trajectory hall(EstimatorKind kind) {
  const LampRun run = simulated_hall(kSeed);
  return below_lamps(run, estimator_of(kind, run.rig));
}

/// The lamps hang irregularly, so that places can be told apart.
constexpr double kOff_m = 0.8;

/// A run on the map of the drive before, as in localised_lab().
Trajectory localised_hall() {
  const LampRun run = simulated_hall(kSeed, kOff_m);
  MapSnapshot map;
  below_lamps(run, estimator_of(EstimatorKind::lamp_ekf, run.rig), &map);
  Configuration configuration;
  configuration.estimator = EstimatorKind::lamp_ekf;
  configuration.map.mode = MapMode::localise;
  return below_lamps(run, configured_estimator(run.rig, configuration, &map));
}

/// The robot is carried away after a round.
Trajectory carried_hall() {
  constexpr int kTakenAt = 160, kPutDownAt = 230;  // numbers of images
  LampRun run = simulated_hall(kSeed, kOff_m);
  run.motions.erase(run.motions.begin() + kTakenAt, run.motions.begin() + kPutDownAt);
  run.sets.erase(run.sets.begin() + kTakenAt, run.sets.begin() + kPutDownAt);
  return below_lamps(run, estimator_of(EstimatorKind::lamp_ekf, run.rig));
}

constexpr std::array kDrives{
    Drive{"lab", lab},
    Drive{"smoothed_lab", smoothed_lab},
    Drive{"delayed_lab", delayed_lab},
    Drive{"nameless_lab", nameless_lab},
    Drive{"features", features},
    Drive{"coloured_images", coloured_images},
    Drive{"localised_lab", localised_lab},
    Drive{"carried_lab", carried_lab},
    Drive{"hall_lamp_ekf", [] { return hall(EstimatorKind::lamp_ekf); }},
    Drive{"hall_fastslam", [] { return hall(EstimatorKind::fastslam); }},
    Drive{"localised_hall", localised_hall},
    Drive{"carried_hall", carried_hall},
};

}  // namespace

std::span<const Drive> drives() { return kDrives; }

}  // namespace azimuth::golden
