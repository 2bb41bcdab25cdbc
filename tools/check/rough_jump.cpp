#include "tools/check/rough_jump.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace azimuth {
namespace {

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

}  // namespace

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

}  // namespace azimuth
