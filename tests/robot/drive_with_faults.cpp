#include "tests/robot/drive_with_faults.hpp"

#include <algorithm>
#include <memory>

#include "sim/world/sensors.hpp"
#include "tests/support/simulated_drive.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;

constexpr Duration kBetweenSets = 200ms, kBetweenFaults = 10s;
constexpr int kLaps = 100;  // more laps than any test drives

RobotSetup setup_for(std::uint64_t seed) {
  RobotSetup setup;
  setup.seed = seed;
  setup.adapter = {100us, 1ms, 700us};
  return setup;
}

}  // namespace

DriveWithFaults::DriveWithFaults(const DriveSetup& settings)
    : scenario_(lab(settings.seed, kLaps)),
      faults_(settings.faults),
      rover_(scenario_, sim::PioneerModel{}.track_mm / 1000.0),
      robot_(setup_for(settings.seed), rover_),
      stage_(std::make_unique<EkfEstimator>(rig_of(scenario_), EkfSettings{}), rig_of(scenario_), StageSettings{}),
      order_(settings.seed, RandomPurpose::scene),
      bearing_random_(settings.seed, RandomPurpose::bearings),
      next_set_(duration_from_seconds(scenario_.sampling.bearing_phase_s)) {
  robot_.fault("watchdog=" + std::to_string(settings.watchdog.count() / 1000));
  robot_.on_sighting = [this](const Sighting& sighting) { note(sighting); };
}

DriveResult DriveWithFaults::run(Duration duration) {
  const Stamp end = robot_.now() + duration;
  run_until(robot_.now() + kBetweenFaults);
  std::size_t next = faults_.size();
  while (robot_.now() < end) {
    if (next == faults_.size()) {
      for (std::size_t i = next - 1; i > 0; --i) std::swap(faults_[i], faults_[order_.index(i + 1)]);
      next = 0;
    }
    strike(faults_[next++]);
  }
  robot_.sightings.shrink_to_fit();
  if (result_.estimates > 0) result_.mean_error_m /= static_cast<double>(result_.estimates);
  return result_;
}

void DriveWithFaults::strike(const PassingFault& fault) {
  const Stamp began = robot_.now();
  result_.struck.push_back({fault.begin, fault.loses_link, Stamp::max(), Stamp::max()});
  robot_.fault(fault.begin);
  run_until(began + fault.lasts);
  if (!fault.end.empty()) robot_.fault(fault.end);
  result_.struck.back().ended = robot_.now();
  run_until(began + kBetweenFaults);
}

void DriveWithFaults::run_until(Stamp end) {
  for (; next_set_ <= end; next_set_ += kBetweenSets) {
    robot_.run_until(next_set_);
    see();
  }
  robot_.run_until(end);
}

void DriveWithFaults::see() {
  const Pose2 T_world_body = rover_.pose_in_world(robot_.now());
  truth_.push_back(T_world_body);
  BearingSet set = observe(scenario_.landmarks, T_world_body, scenario_.sensor, bearing_random_);
  set.stamp = robot_.now();
  set.sequence = sets_++;
  stage_.add(set);
  take_estimates();
}

void DriveWithFaults::note(const Sighting& sighting) {
  if (!result_.struck.empty()) {
    Struck& struck = result_.struck.back();
    if (struck.ended != Stamp::max() && struck.back == Stamp::max()) struck.back = sighting.taken_at;
  }
  stage_.add(sighting.reading);
  take_estimates();
}

void DriveWithFaults::take_estimates() {
  while (stage_.advance(estimate_)) judge(estimate_);
}

bool DriveWithFaults::settled(Stamp stamp) const {
  constexpr Duration kToSettle = 3s;
  if (result_.struck.empty()) return true;
  const Struck& last = result_.struck.back();
  return last.back != Stamp::max() && stamp > last.back + kToSettle;
}

/// The map frame is the true pose of the first estimate.
void DriveWithFaults::judge(const Estimate& estimate) {
  const Stamp first_set(duration_from_seconds(scenario_.sampling.bearing_phase_s));
  const Pose2& truth = truth_[static_cast<std::size_t>((estimate.stamp - first_set) / kBetweenSets)];
  if (result_.estimates++ == 0) T_world_map_ = truth;
  const Eigen::Vector2d error_m = (inverse(T_world_map_) * truth).position() - estimate.T_map_body.position();
  result_.final_error_m = error_m.norm();
  result_.mean_error_m += error_m.norm();
  result_.max_error_m = std::max(result_.max_error_m, error_m.norm());
  if (settled(estimate.stamp)) result_.max_settled_error_m = std::max(result_.max_settled_error_m, error_m.norm());
  result_.not_tracking += estimate.health != Health::tracking;
  result_.lost += estimate.health == Health::lost;
}

}  // namespace azimuth::test
