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
#include "tools/simulated/rendered_run.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth::golden {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr Stamp kTaken{std::chrono::seconds(170)}, kPutDown{std::chrono::seconds(193)};

Rig rig_of(const Run& run) { return read_rig(run.rig_toml, run.rig_file).value(); }

/// Samples to the stage in the order that a replay has. `map` is what is known in the end.
std::unique_ptr<Estimator> estimator_named(std::string_view name, const Rig& rig) {
  Configuration configuration;
  configuration.estimator = name;
  return configured_estimator(rig, configuration);
}

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
  return through_the_stage(run, rig, sets, estimator_named("ekf", rig));
}

/// Landmarks with names: the run that ships.
Trajectory lab() {
  const Run run = *load_run(test::source_folder() / "runs/lab");
  return through_the_stage(run, rig_of(run));
}

/// The same, each pose by all that was seen until then.
Trajectory smoothed_lab() {
  const Run run = *load_run(test::source_folder() / "runs/lab");
  const Rig rig = rig_of(run);
  RecordedSets sets(run);
  return through_the_stage(run, rig, sets, estimator_named("smoother", rig));
}

/// A round of stops a metre apart, each landmark mapped only when two bearings of it cross well.
Trajectory delayed_lab() {
  const Run run = simulated_run(coloured_lab(kSeed));
  const Rig rig = rig_of(run);
  const std::array<std::string, 2> delayed{"estimator=ekf", "ekf.initialisation=delayed"};
  RecordedSets sets(run);
  return through_the_stage(run, rig, sets, configured_estimator(rig, read_configuration("", "", delayed).value()));
}

/// The same kind of drive without names, with clutter: which bearing is of which landmark is found out.
Trajectory nameless_lab() {
  Scenario scenario = azimuth::lab(kSeed, 2);
  scenario.sensor.identities = false;
  scenario.sensor.clutter_per_set = 0.2;
  const Run run = simulated_run(scenario);
  return through_the_stage(run, rig_of(run));
}

/// Features told apart by their looks.
Trajectory features() {
  const FeatureWorld world = feature_world(kSeed);
  Rig rig = rig_of(world.run);
  rig.front_end = FrontEnd::sift;
  rig.camera.identities = false;
  return through_the_stage(world.run, rig);
}

/// From images: coloured cylinders, rendered here.
Trajectory coloured_images() {
  const test::TemporaryFolder folder;
  const Run run = *rendered_run(coloured_lab(kSeed), {}, folder.path());
  const Rig rig = rig_of(run);
  SeenSets sets(run, rig.camera.image, {make_perception(rig.front_end, rig.camera, {}), decoded_format(rig.front_end)});
  return through_the_stage(run, rig, sets, estimator_named("ekf", rig));
}

/// On the map of the drive before, which stays as it is; where the robot is in it has to be found first.
Trajectory localised_lab() {
  const Run run = *load_run(test::source_folder() / "runs/lab");
  const Rig rig = rig_of(run);
  MapSnapshot map;
  RecordedSets first(run), second(run);
  through_the_stage(run, rig, first, estimator_named("ekf", rig), &map);
  Configuration configuration;
  configuration.estimator = "ekf";
  configuration.map.mode = MapMode::localise;
  return through_the_stage(run, rig, second, configured_estimator(rig, configuration, &map));
}

/// Carried a third of a round away after two rounds among colours, and noticed, and found again.
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

/// `map` is what is known in the end.
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

Trajectory hall(std::string_view estimator_name) {
  const LampRun run = simulated_hall(kSeed);
  return below_lamps(run, estimator_named(estimator_name, run.rig));
}

/// Lamps that hang irregularly, so that one place can be told from another.
constexpr double kOff_m = 0.8;

/// On the map of the drive before, as localised_lab().
Trajectory localised_hall() {
  const LampRun run = simulated_hall(kSeed, kOff_m);
  MapSnapshot map;
  below_lamps(run, estimator_named("lamp_ekf", run.rig), &map);
  Configuration configuration;
  configuration.estimator = "lamp_ekf";
  configuration.map.mode = MapMode::localise;
  return below_lamps(run, configured_estimator(run.rig, configuration, &map));
}

/// Carried off after a round.
Trajectory carried_hall() {
  constexpr int kTakenAt = 160, kPutDownAt = 230;  // images
  LampRun run = simulated_hall(kSeed, kOff_m);
  run.motions.erase(run.motions.begin() + kTakenAt, run.motions.begin() + kPutDownAt);
  run.sets.erase(run.sets.begin() + kTakenAt, run.sets.begin() + kPutDownAt);
  return below_lamps(run, estimator_named("lamp_ekf", run.rig));
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
    Drive{"hall_lamp_ekf", [] { return hall("lamp_ekf"); }},
    Drive{"hall_fastslam", [] { return hall("fastslam"); }},
    Drive{"localised_hall", localised_hall},
    Drive{"carried_hall", carried_hall},
};

}  // namespace

std::span<const Drive> drives() { return kDrives; }

}  // namespace azimuth::golden
