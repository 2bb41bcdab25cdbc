#include "sim/azimuth_sim/simulation.hpp"

#include <algorithm>
#include <utility>

namespace azimuth::sim {
namespace {

Duration period(double seconds) { return std::max(Duration(1000), duration_from_seconds(seconds)); }

}  // namespace

void SimulationOutput::clear() {
  bearings.clear();
  truth.clear();
  odometry.clear();
  frames.clear();
  can_frames.clear();
  latches.clear();
  faults.clear();
}

bool Simulation::Timer::ring(Stamp now) {
  if (now < next_) return false;
  next_ += period_;
  return true;
}

Simulation::Simulation(const SimulationSettings& settings)
    : scenario_(settings.scenario),
      faults_(settings.faults),
      rover_(scenario_, settings.model.track_mm / 1000.0, settings.left_alone),
      pioneer_(settings.model, rover_, scenario_.seed),
      bearing_random_(scenario_.seed, RandomPurpose::bearings),
      truth_(rover_.tick(), {}),
      odometry_(period(scenario_.sampling.odometry_period_s), {}),
      bearings_(period(scenario_.sampling.bearing_period_s),
                duration_from_seconds(scenario_.sampling.bearing_phase_s)) {
  if (settings.frame_period) frames_.emplace(*settings.frame_period, Duration{});
  if (settings.has_can_base) can_.emplace(kCanCycle, Duration{});
}

Stamp Simulation::due() const {
  const Stamp frame = frames_ ? frames_->due() : Stamp::max();
  const Stamp can = can_ ? can_->due() : Stamp::max();
  return std::min({pioneer_.due(), faults_.due(), truth_.due(), odometry_.due(), bearings_.due(), frame, can});
}

void Simulation::advance(Stamp now, SimulationOutput& output) {
  while (due() <= now) step(due(), output);
  pioneer_.advance(now);
}

void Simulation::step(Stamp now, SimulationOutput& output) {
  pioneer_.advance(now);
  for (const Fault& fault : faults_.take(now)) {
    fault.apply(pioneer_);
    output.faults.push_back(fault);
  }
  take_samples(now, output);
  for (const SipLatch& latch : pioneer_.take_latches()) output.latches.push_back(latch);
}

void Simulation::take_samples(Stamp now, SimulationOutput& output) {
  if (odometry_.ring(now)) output.odometry.push_back({now, odometry_count_++, 0, rover_.pose_in_odom(now)});
  if (truth_.ring(now)) output.truth.push_back({now, rover_.pose_in_world(now)});
  if (frames_ && frames_->ring(now)) output.frames.push_back({now, rover_.pose_in_world(now)});
  if (bearings_.ring(now)) see(now, output);
  if (can_ && can_->ring(now)) report_on_can(now, output);
}

/// The base has the same faults as the controller: a restart or silence of the controller applies to the base too.
void Simulation::report_on_can(Stamp now, SimulationOutput& output) {
  const WheelMotion rolled = rover_.rolled_by(now);
  if (std::exchange(can_reboots_, pioneer_.counts().reboots) != pioneer_.counts().reboots) can_base_.restart(rolled);
  if (!pioneer_.passes()) return;
  const FirmwareQuirks& quirks = pioneer_.firmware().quirks;
  const bool bumper = quirks.left_stall_bumpers > 1 || quirks.right_stall_bumpers > 1;
  can_base_.report({rolled, quirks.emergency_stop, bumper, pioneer_.firmware().model().battery_v}, output.can_frames);
}

void Simulation::see(Stamp now, SimulationOutput& output) {
  BearingSet set = observe(scenario_.landmarks, rover_.pose_in_world(now), scenario_.sensor, bearing_random_);
  set.stamp = now;
  set.sequence = bearing_count_++;
  output.bearings.push_back(std::move(set));
}

}  // namespace azimuth::sim
