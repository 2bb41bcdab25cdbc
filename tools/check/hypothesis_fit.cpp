#include "tools/check/hypothesis_fit.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

// Finds the instant at which the camera's clock may have jumped.

// Largest lag that is tried, since cameras may buffer images for seconds; and the limit below which steps are fine.
constexpr double kMost_s = 6.0, kFine_s = 1.0;

constexpr double kStep_s = 0.1, kCoarse_s = 0.2;

constexpr double kLeastJump_s = 0.15;

// Two lags must reduce the cost of the bearings by at least this. A smaller reduction may be chance.
constexpr double kLeastSaved = 10.0;

std::vector<double> lags() {
  std::vector<double> lags_s;
  for (double lag_s = -kMost_s; lag_s <= kMost_s + 1e-9;
       lag_s += std::abs(lag_s) < kFine_s - 1e-9 || std::abs(lag_s + kFine_s) < 1e-9 ? kStep_s : kCoarse_s)
    lags_s.push_back(lag_s);
  return lags_s;
}

RigGuess with_lag(RigGuess guess, double lag_s) {
  guess.rig.odometry.lag_s += lag_s;
  return guess;
}

struct TwoLags {
  std::size_t first_after = 0;  // index of the first stretch after the jump
  double before_s = 0.0, after_s = 0.0;
  double cost = 0.0;
};

/// For each number n of stretches: the least total cost of the first n stretches with one common lag, and that lag.
struct Cheapest {
  std::vector<double> cost, lag_s;
};

Cheapest cheapest_up_to(const std::vector<std::vector<double>>& costs, const std::vector<double>& lags_s) {
  const std::size_t stretches = costs.front().size();
  Cheapest result;
  std::vector<double> sums(lags_s.size());
  for (std::size_t end = 0; end <= stretches; ++end) {
    const auto least = std::ranges::min_element(sums);
    result.cost.push_back(*least);
    result.lag_s.push_back(lags_s[static_cast<std::size_t>(least - sums.begin())]);
    if (end == stretches) break;
    for (std::size_t lag = 0; lag < lags_s.size(); ++lag) sums[lag] += costs[lag][end];
  }
  return result;
}

TwoLags best_two(std::vector<std::vector<double>> costs, const std::vector<double>& lags_s) {
  const Cheapest before = cheapest_up_to(costs, lags_s);
  for (std::vector<double>& each : costs) std::ranges::reverse(each);
  const Cheapest after = cheapest_up_to(costs, lags_s);
  const std::size_t stretches = before.cost.size() - 1;
  TwoLags best{.cost = before.cost.back()};
  for (std::size_t first = 1; first < stretches; ++first) {
    const double cost = before.cost[first] + after.cost[stretches - first];
    if (cost < best.cost) best = {first, before.lag_s[first], after.lag_s[stretches - first], cost};
  }
  return best;
}

/// Refines the instant of the jump within the two stretches around it.
RigGuess at_best_image(ShortStretches& stretches, const Drive& drive, RigGuess guess, std::size_t first_after) {
  const std::vector<Stamp>& starts = stretches.starts();
  const Stamp from = starts[first_after - 1],
              to = first_after + 1 < starts.size() ? starts[first_after + 1] : drive.sets.back().stamp;
  constexpr int kTries = 24;
  RigGuess best = guess;
  double least = stretches.cost(best);
  for (int i = 1; i < kTries; ++i) {
    guess.jump.at = from + (to - from) * i / kTries;
    const double cost = stretches.cost(guess);
    if (cost < least) {
      least = cost;
      best = guess;
    }
  }
  best.jump.after_s = to_seconds(best.jump.at - drive.sets.front().stamp);
  return best;
}

/// The guess with the clock jump that fits short stretches best. The search finds two lags, one before and one after an
/// instant, that minimise the total cost of all stretches. Nothing if one lag fits as well.
std::optional<RigGuess> rough_jump(ShortStretches& stretches, const Drive& drive, const RigGuess& guess) {
  if (guess.jump.by_s != 0.0) return std::nullopt;
  const std::vector<double> lags_s = lags();
  std::vector<std::vector<double>> costs;
  double at_one_lag = std::numeric_limits<double>::infinity();
  for (const double lag_s : lags_s) {
    costs.push_back(stretches.costs(with_lag(guess, lag_s)));
    double sum = 0.0;
    for (const double each : costs.back()) sum += each;
    at_one_lag = std::min(at_one_lag, sum);
  }
  const TwoLags two = best_two(std::move(costs), lags_s);
  const double by_s = two.after_s - two.before_s;
  if (two.first_after == 0 || std::abs(by_s) < kLeastJump_s || two.cost + kLeastSaved > at_one_lag) return std::nullopt;
  RigGuess jumped = with_lag(guess, two.before_s);
  jumped.numbers = MotionNumbers::jump;
  jumped.jump = {.at = stretches.starts()[two.first_after], .after_s = 0.0, .by_s = by_s};
  return at_best_image(stretches, drive, jumped, two.first_after);
}

// Standard deviations that limit how far a free number may move in one step.
constexpr FreeErrors kFreeHeading{.sigma_camera_yaw_rad = 0.3};
constexpr FreeErrors kFreeTurn{.sigma_scale_turn = 0.1};
constexpr FreeErrors kFreeDrift{.sigma_drift_rad_per_m = 0.05};
constexpr FreeErrors kFreeLag{.sigma_lag_s = 0.2};
constexpr FreeErrors kFreeClock{.sigma_lag_s = 0.2, .sigma_lag_growth = 0.01};
constexpr FreeErrors kFreeMount{.sigma_lag_s = 0.3, .sigma_lag_growth = 0.3};
constexpr FreeErrors kFreeJump{.sigma_lag_s = 0.2, .sigma_lag_growth = 0.2};
constexpr FreeErrors kFreeCentre{.sigma_centre_px = 10.0};
// Smallest step of the search for the instant of a clock jump. The instant is observable only to half the interval
// between images.
constexpr Duration kFinestInstant = std::chrono::milliseconds(100);
// A rough guess starts a new fit of the drive only if its cost is below this fraction of the present cost.
constexpr double kWorthIt = 0.97;
// Energy per bearing above which the first fit stops. Residuals of three standard deviations on all bearings give less.
constexpr double kNothingFits = 3.0;

bool any_radius(const Drive& drive) {
  for (const BearingSet& set : drive.sets)
    for (const Bearing& bearing : set.bearings)
      if (!std::isnan(bearing.radius_px)) return true;
  return false;
}

/// The guess for a mirrored world, in which turns have the opposite sign.
RigGuess in_a_mirror(RigGuess guess) {
  guess.mirrored = !guess.mirrored;
  return guess;
}

}  // namespace

Explanations::Explanations(const Drive& drive, const Rig& said, const HindsightSettings& settings)
    : drive_(drive),
      said_(said),
      settings_(settings),
      stretches_(drive, said),
      now_(followed_and_solved(drive, {.rig = said}, {}, settings,
                               kNothingFits * static_cast<double>(drive.named_bearings()))),
      least_energy_(now_.energy),
      has_radii_(any_radius(drive)) {}

/// Fits the drive from the start with `guess`. The fit stops early when the energy exceeds the least energy so far by
/// one per bearing: the rest of the drive cannot make up for that.
DriveSolution Explanations::begun_anew(const RigGuess& guess, const FreeErrors& free) const {
  const double hopeless = least_energy_ + static_cast<double>(now_.graph.bearings());
  return followed_and_solved(drive_, guess, free, settings_, hopeless);
}

DriveSolution Explanations::better(const DriveSolution& a, const DriveSolution& b) const {
  return a.energy <= b.energy ? a : b;
}

/// The better of two fits: one starts from the present solution, one from the result of a rough search.
DriveSolution Explanations::with_free(const FreeErrors& free, const RoughSearch& search) {
  const DriveSolution from_here = solved(drive_, now_.graph, now_.guess, free, settings_);
  const RigGuess rough = rough_guesses(stretches_, now_.guess, search).front();
  if (stretches_.cost(rough) > kWorthIt * stretches_.cost(now_.guess)) return from_here;
  return better(from_here, begun_anew(rough, free));
}

/// The fit with azimuths that grow the other way. For image cameras the yaw changes so that the rig's azimuth offset
/// keeps its value.
DriveSolution Explanations::mirrored_camera() {
  RigGuess guess = in_a_mirror(now_.guess);
  if (sees_images(said_)) {
    const double hand = now_.guess.mirrored ? -1.0 : 1.0;
    double& yaw_rad = guess.rig.camera.yaw_offset_rad;
    yaw_rad = wrap(yaw_rad + hand * 2.0 * said_.camera.image.azimuth_offset_rad);
  }
  return begun_anew(guess, {});
}

DriveSolution Explanations::swapped_wheels() {
  RigGuess guess = now_.guess;
  guess.rig.odometry.wheels_swapped = !guess.rig.odometry.wheels_swapped;
  return begun_anew(guess, {});
}

/// The fit with a free camera position. It starts from the present solution, since the position is never far off.
DriveSolution Explanations::mounted_elsewhere() {
  RigGuess guess = now_.guess;
  guess.numbers = MotionNumbers::mount;
  return solved(drive_, now_.graph, guess, kFreeMount, settings_);
}

/// Refines the instant of the jump. The graph does not estimate the instant, and short stretches give it only to some
/// seconds, or wrongly if few landmarks are near. A search with decreasing steps therefore minimises the energy of the
/// whole drive over the instant.
DriveSolution Explanations::jumped_when_it_fits_best(DriveSolution jumped) const {
  if (jumped.energy >= now_.energy) return jumped;
  const Stamp first = drive_.sets.front().stamp, last = drive_.sets.back().stamp;
  const auto moved_by = [&](Duration step) {
    RigGuess guess = jumped.guess;
    guess.jump.at = std::clamp(guess.jump.at + step, first, last);
    guess.jump.after_s = to_seconds(guess.jump.at - first);
    return solved(drive_, jumped.graph, guess, kFreeJump, settings_);
  };
  for (Duration step = (last - first) / 8; step >= kFinestInstant; step /= 2)
    for (const Duration by : {step, -step})
      for (DriveSolution other = moved_by(by); other.energy < jumped.energy; other = moved_by(by)) jumped = other;
  return jumped;
}

void Explanations::accept(const DriveSolution& solution) {
  now_ = solution;
  now_.guess.numbers = MotionNumbers::clock;
  least_energy_ = now_.energy;
}

std::optional<Explanation> Explanations::explanation(Mistake mistake) {
  std::optional<Explanation> explanation = tried(mistake);
  if (explanation) least_energy_ = std::min(least_energy_, explanation->solution.energy);
  return explanation;
}

std::optional<Explanation> Explanations::tried(Mistake mistake) {
  switch (mistake) {
    case Mistake::hand:
      return Explanation{mistake, 0, {}, mirrored_camera()};
    case Mistake::wheels:
      return Explanation{mistake, 0, {}, swapped_wheels()};
    case Mistake::heading:
      return Explanation{mistake, 1, kFreeHeading, with_free(kFreeHeading, {.yaw = true})};
    case Mistake::turn: {
      const DriveSolution turned = with_free(kFreeTurn, {.turn = true});
      // A negative scale is equivalent to a mirrored world.
      if (turned.guess.rig.odometry.scale_turn <= 0.0) return std::nullopt;
      return Explanation{mistake, 1, kFreeTurn, turned};
    }
    case Mistake::drift:
      return Explanation{mistake, 1, kFreeDrift, better(with_free(kFreeDrift, {}), begun_anew(now_.guess, kFreeDrift))};
    case Mistake::lag:
      return Explanation{mistake, 1, kFreeLag, with_free(kFreeLag, {.lag = true})};
    case Mistake::clock: {
      const DriveSolution late = with_free(kFreeLag, {.lag = true});
      return Explanation{mistake, 2, kFreeClock,
                         better(solved(drive_, now_.graph, now_.guess, kFreeClock, settings_),
                                solved(drive_, late.graph, late.guess, kFreeClock, settings_))};
    }
    case Mistake::jump: {
      const std::optional<RigGuess> rough = rough_jump(stretches_, drive_, now_.guess);
      if (!rough) return std::nullopt;
      return Explanation{mistake, 3, kFreeJump, jumped_when_it_fits_best(begun_anew(*rough, kFreeJump))};
    }
    case Mistake::mount:
      return Explanation{mistake, 2, kFreeMount, mounted_elsewhere()};
    case Mistake::centre:
      if (!has_radii_) return std::nullopt;
      return Explanation{mistake, 2, kFreeCentre, with_free(kFreeCentre, {})};
    case Mistake::leaps:
    case Mistake::senders:
    case Mistake::tilt:
    case Mistake::creep:
    case Mistake::distance:
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace azimuth
