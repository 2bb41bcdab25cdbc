#include "tests/tools/check/spoilings.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "slam/geometry/angle.hpp"
#include "tests/support/spoilt_run.hpp"

namespace azimuth::test {
namespace {

/// The clock drifts by half a second over the whole drive.
Run with_drifting_clock(Run run) {
  const double drive_s = to_seconds(run.odometry.back().stamp - run.odometry.front().stamp);
  return test::with_late_odometry(std::move(run), 0.0, 0.5 / drive_s);
}

Spoiling askew(const char* name, double by_rad) {
  return {name, Mistake::heading,
          "camera.yaw_offset_rad = ", [by_rad](Run run) { return with_turned_camera(std::move(run), by_rad); }, by_rad};
}

}  // namespace

const std::vector<Spoiling>& spoilings() {
  static const std::vector<Spoiling> all{
      {"FlippedDirection", Mistake::hand, "camera.azimuths_clockwise = true", with_mirrored_azimuths},
      {"NinetyDegreesOff", Mistake::heading,
       "camera.yaw_offset_rad = ", [](Run run) { return with_turned_camera(std::move(run), 0.5 * kPi); }},
      {"TurnScale", Mistake::turn,
       "odometry.scale_turn = ", [](Run run) { return with_scaled_turns(std::move(run), 1.3); }},
      {"DistanceScale", Mistake::distance,
       "odometry.scale_distance = ", [](Run run) { return with_scaled_distances(std::move(run), 1.3); }},
      {"Lag", Mistake::lag, "odometry.lag_s = ", [](Run run) { return with_late_odometry(std::move(run), 0.3); }},
      {"SwappedWheels", Mistake::wheels, "odometry.wheels_swapped = true", with_swapped_wheels},
      {"CentreOff", Mistake::centre, "camera.centre_px",
       [](Run run) {
         return with_centre_off(std::move(run), {12.0, -16.0});
       }},
      {"DriftingClock", Mistake::clock, "odometry.clock_drift = ", with_drifting_clock},
  };
  return all;
}

const std::vector<Spoiling>& further_spoilings() {
  static const std::vector<Spoiling> all{
      askew("Backwards", kPi),
      askew("AskewBy2", degrees_to_rad(2.0)),
      askew("AskewBy5", degrees_to_rad(-5.0)),
      askew("AskewBy10", degrees_to_rad(10.0)),
      {"WrappingWheels", Mistake::leaps, "wrap", with_wrapping_wheels},
      {"Creep", Mistake::creep,
       "odometry.floor_rotation_rad = ", [](Run run) { return with_creep(std::move(run), 20.0, 0.004, 0.002); }},
      {"TwoSenders", Mistake::senders, "two senders", with_two_senders},
      {"JumpingClock", Mistake::jump, "the camera's clock",
       [](Run run) { return with_jumping_clock(std::move(run), 0.7); }},
  };
  return all;
}

std::string said(const Plausibility& found) {
  std::string text;
  for (const MistakeVerdict& verdict : found.verdicts)
    text += fmt::format("  {:<10} {} {}\n", to_string(verdict.mistake),
                        verdict.says == MistakeVerdict::Says::wrong ? "WRONG" : "", verdict.sentence);
  return text;
}

bool names_it(const Plausibility& found, const Spoiling& spoiling) {
  for (const MistakeVerdict& verdict : found.verdicts) {
    const bool is_it = verdict.mistake == spoiling.mistake;
    if ((verdict.says == MistakeVerdict::Says::wrong) != is_it) return false;
    if (is_it && verdict.sentence.find(spoiling.key) == std::string::npos) return false;
  }
  return true;
}

bool names_another(const Plausibility& found, const Spoiling& spoiling) {
  return std::ranges::any_of(found.verdicts, [&](const MistakeVerdict& verdict) {
    return verdict.says == MistakeVerdict::Says::wrong && verdict.mistake != spoiling.mistake;
  });
}

}  // namespace azimuth::test
