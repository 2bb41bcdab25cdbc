#include "tools/drive_fit/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "slam/geometry/angle.hpp"
#include "tools/drive_fit/short_stretches.hpp"

namespace azimuth {
namespace {

// Prior standard deviations for an uncalibrated robot, which also limit the steps of the fit.
constexpr double kTurn = 0.1, kDrift_rad_per_m = 0.05, kLag_s = 0.2, kYaw_rad = 0.3;
// A number is told if its standard deviation is at most this fraction of the prior one.
constexpr double kTold = 0.5;
// Required accuracy of the camera's yaw: two standard deviations are half a degree.
constexpr double kToldYaw_rad = 0.25 * kPi / 180.0;
// Prior standard deviation and required accuracy of the camera's position. Two standard deviations are five
// centimetres: for a landmark two metres away, such an error equals the noise of a good bearing.
constexpr double kMount_m = 0.5, kToldMount_m = 0.025;
// A likelihood ratio of ten thousand to one.
const double kSure = std::log(1e4);
constexpr std::size_t kLeastBearings = 30;

FreeErrors free_odometry() {
  return {.sigma_scale_turn = kTurn, .sigma_drift_rad_per_m = kDrift_rad_per_m, .sigma_lag_s = kLag_s};
}

}  // namespace

FreeErrors free_heading() {
  FreeErrors free = free_odometry();
  free.sigma_camera_yaw_rad = kYaw_rad;
  return free;
}

namespace {

/// Priors for MotionNumbers::mount, where the two numbers for lag and its growth are the camera's position.
FreeErrors free_mount() {
  FreeErrors free = free_heading();
  free.sigma_lag_s = free.sigma_lag_growth = kMount_m;
  return free;
}

double sigma_of(const Eigen::Matrix<double, kCalibrations, kCalibrations>& spread, int which) {
  return std::sqrt(std::max(0.0, spread(which, which)));
}

/// Resets each untold number to the rig's value and fixes it. Returns true if any number is untold.
bool hold_what_is_not_told(const OdometryCalibration& found, const Rig& rig, RigGuess& guess, FreeErrors& free) {
  if (!found.turn.told) {
    free.sigma_scale_turn = 0.0;
    guess.rig.odometry.scale_turn = rig.odometry.scale_turn;
  }
  if (!found.drift.told) {
    free.sigma_drift_rad_per_m = 0.0;
    guess.rig.odometry.drift_rad_per_m = rig.odometry.drift_rad_per_m;
  }
  if (!found.lag.told) {
    free.sigma_lag_s = 0.0;
    guess.rig.odometry.lag_s = rig.odometry.lag_s;
  }
  return !(found.turn.told && found.drift.told && found.lag.told);
}

/// Reads the numbers that were free in the fit.
void read_numbers(const Eigen::Matrix<double, kCalibrations, kCalibrations>& spread, const FreeErrors& free,
                  OdometryCalibration& found) {
  const OdometryRig& odometry = found.solution.guess.rig.odometry;
  const auto read = [&](double value, int which, double untold, double was_free, FoundNumber& number) {
    if (was_free == 0.0) return;
    const double sigma = sigma_of(spread, which);
    number = {value, sigma, sigma > 0.0 && sigma <= kTold * untold};
  };
  read(odometry.scale_turn, calibration::scale_turn, kTurn, free.sigma_scale_turn, found.turn);
  read(odometry.drift_rad_per_m, calibration::drift, kDrift_rad_per_m, free.sigma_drift_rad_per_m, found.drift);
  read(odometry.lag_s, calibration::lag, kLag_s, free.sigma_lag_s, found.lag);
}

using Spread = Eigen::Matrix<double, kCalibrations, kCalibrations>;

/// The jackknife covariance of spread_of(), increased for two further uncertainties: the odometry noise is known only
/// approximately, and the large turns alone may give other numbers than all turns, because the driver's corrections of
/// heading errors bias the small ones (see motions_between()).
Spread spread_with_doubts(const Drive& drive, const OdometryCalibration& found, const FreeErrors& free,
                          const HindsightSettings& settings) {
  Spread spread = spread_of(drive, found.solution, free, settings);
  spread *= 1.0 + std::min(found.noise.of(NoiseSort::rotation).sigma_relative,
                           found.noise.of(NoiseSort::drift).sigma_relative);
  RigGuess guess = found.solution.guess;
  guess.large_turns_alone = true;
  const DriveSolution large = solved(drive, found.solution.graph, guess, free, settings);
  spread.diagonal() += (numbers_of(large.guess) - numbers_of(found.solution.guess)).cwiseAbs2();
  return spread;
}

DriveSolution best_of(const DriveSolution& a, const DriveSolution& b) { return a.energy <= b.energy ? a : b; }

}  // namespace

OdometryCalibration calibrate_odometry(const Drive& drive, const Rig& rig, const HindsightSettings& settings) {
  FreeErrors free = free_odometry();
  const RigGuess said{.rig = rig};
  ShortStretches stretches(drive, rig);
  const RigGuess rough = rough_guesses(stretches, said, {.turn = true, .lag = true}).front();
  OdometryCalibration found;
  found.solution = followed_and_solved(drive, rough, free, settings);
  const double hopeless = found.solution.energy + static_cast<double>(found.solution.graph.bearings());
  if (numbers_of(rough) != numbers_of(said))
    found.solution = best_of(found.solution, followed_and_solved(drive, said, free, settings, hopeless));
  for (int times = 0; times < 2; ++times) {
    // The prior of the noise is the rig's noise in both rounds.
    DriveSolution as_said = found.solution;
    as_said.guess.rig.odometry = with_noise_of(as_said.guess.rig.odometry, rig.odometry);
    found.noise = odometry_noise(drive, as_said, settings);
    RigGuess guess = found.solution.guess;
    guess.rig.odometry = with_noise(guess.rig.odometry, found.noise);
    found.solution = solved(drive, found.solution.graph, guess, free, settings);
    read_numbers(spread_with_doubts(drive, found, free, settings), free, found);
    guess = found.solution.guess;
    if (!hold_what_is_not_told(found, rig, guess, free)) break;
    found.solution = solved(drive, found.solution.graph, guess, free, settings);
  }
  found.creep = creep_of(drive, found.solution);
  OdometryRig& odometry = found.solution.guess.rig.odometry;
  if (found.creep.is_told()) odometry = with_floors_of(odometry, found.creep);
  return found;
}

namespace {

/// Determines the camera's position if the drive tells it. A lag must not explain the drive as well: for a robot that
/// drives straight at constant speed, a lag and a camera ahead of the axle are equivalent.
void mount_elsewhere(const Drive& drive, const DriveSolution& start, const HindsightSettings& settings,
                     HeadingCalibration& found, Spread& spread) {
  RigGuess guess = start.guess;
  guess.numbers = MotionNumbers::mount;
  const DriveSolution mounted = solved(drive, start.graph, guess, free_mount(), settings);
  if (mounted.energy > found.solution.energy) return;
  const Spread spread_mounted = spread_of(drive, mounted, free_mount(), settings);
  const double sigma_ahead_m = sigma_of(spread_mounted, calibration::lag),
               sigma_left_m = sigma_of(spread_mounted, calibration::lag_growth);
  if (!(sigma_ahead_m > 0.0 && sigma_left_m > 0.0 && std::max(sigma_ahead_m, sigma_left_m) <= kToldMount_m)) return;
  const Eigen::Vector2d position_m = mount_of(mounted.guess.rig);
  found.ahead = {position_m.x(), sigma_ahead_m, true};
  found.left = {position_m.y(), sigma_left_m, true};
  found.solution = mounted;
  spread = spread_mounted;
}

}  // namespace

HeadingCalibration calibrate_heading(const Drive& drive, const Rig& rig, const HindsightSettings& settings) {
  // The scale of turns stays fixed: a free one could become negative, and both hands would fit equally well.
  const FreeErrors yaw_alone{.sigma_camera_yaw_rad = kYaw_rad};
  ShortStretches stretches(drive, rig);
  std::vector<DriveSolution> hands;
  double hopeless = std::numeric_limits<double>::infinity();
  for (const RigGuess& rough : rough_guesses(stretches, {.rig = rig}, {.hand = true, .yaw = true})) {
    hands.push_back(followed_and_solved(drive, rough, yaw_alone, settings, hopeless));
    hopeless = hands.back().energy + static_cast<double>(hands.back().graph.bearings());
  }
  std::ranges::stable_sort(hands, {}, &DriveSolution::energy);
  HeadingCalibration found;
  found.hand_told = evidence(hands.front(), hands.back()) > kSure;
  found.solution = solved(drive, hands.front().graph, hands.front().guess, free_heading(), settings);
  Spread spread = spread_of(drive, found.solution, free_heading(), settings);
  mount_elsewhere(drive, hands.front(), settings, found, spread);
  found.mirrored = found.solution.guess.mirrored;
  const double sigma = sigma_of(spread, calibration::yaw);
  found.yaw = {found.solution.guess.rig.camera.yaw_offset_rad, sigma, sigma > 0.0 && sigma <= kToldYaw_rad};
  return found;
}

double evidence(const DriveSolution& better, const DriveSolution& than) {
  const auto bearings = static_cast<double>(std::max<std::size_t>(1, better.graph.bearings()));
  return (than.energy - better.energy) / std::max(1.0, 2.0 * better.energy / bearings);
}

std::string why_cannot_tell(const Drive& drive, const Rig& rig) {
  const std::size_t named = drive.named_bearings();
  if (named == 0 && !drive.names_are_landmarks)
    return fmt::format(
        "of what {} images show nothing could be followed from one to the next, and that is what tells: cannot tell "
        "without more images to a metre",
        drive.sets.size());
  if (named == 0)
    return fmt::format(
        "none of the bearings in {} sets says which landmark it is of, and that is what tells: cannot "
        "tell without (camera.identities)",
        drive.sets.size());
  const ShortStretches stretches(drive, rig);
  if (stretches.judged() < kLeastBearings)
    return fmt::format(
        "cannot tell: of {} bearings with names only {} are of landmarks that were seen three times on "
        "a few metres; drive longer, and turn both ways",
        named, stretches.judged());
  return {};
}

}  // namespace azimuth
