#include "tools/compare/inference.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace azimuth {
namespace {

constexpr std::size_t kSamples = 4000;

/// SplitMix64 generator. The distributions of the standard library differ between implementations.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}

  std::size_t below(std::size_t count) {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9ULL;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBULL;
    const double part = static_cast<double>((mixed ^ (mixed >> 31)) >> 11) * 0x1p-53;
    return static_cast<std::size_t>(part * static_cast<double>(count));
  }

 private:
  std::uint64_t state_;
};

double mean_of_sample(std::span<const double> values, Dice& dice) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[dice.below(values.size())];
  return sum / static_cast<double>(values.size());
}

double percentile(const std::vector<double>& sorted, double part) {
  const double place = part * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// The continued fraction of the incomplete beta function, by Lentz's method.
double beta_fraction(double x, double a, double b) {
  constexpr double kTiny = 1e-300;
  const auto kept = [](double value) { return std::abs(value) < kTiny ? kTiny : value; };
  double c = 1.0, d = 1.0 / kept(1.0 - (a + b) * x / (a + 1.0)), fraction = d;
  for (int m = 1; m <= 500; ++m) {
    const double k = m;
    const double even = k * (b - k) * x / ((a + 2.0 * k - 1.0) * (a + 2.0 * k));
    const double odd = -(a + k) * (a + b + k) * x / ((a + 2.0 * k) * (a + 2.0 * k + 1.0));
    for (const double term : {even, odd}) {
      d = 1.0 / kept(1.0 + term * d);
      c = kept(1.0 + term / c);
      fraction *= c * d;
    }
    if (std::abs(c * d - 1.0) < 1e-15) break;
  }
  return fraction;
}

/// The regularised incomplete beta function.
double incomplete_beta(double x, double a, double b) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return 1.0;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  return x < (a + 1.0) / (a + b + 2.0) ? front * beta_fraction(x, a, b) / a
                                       : 1.0 - front * beta_fraction(1.0 - x, b, a) / b;
}

}  // namespace

MeanInterval bootstrap_mean(std::span<const double> values, std::uint64_t seed) {
  if (values.empty()) return {kNoNumber, kNoNumber, kNoNumber, 0};
  const double mean = spread(values).mean;
  if (values.size() < 2) return {mean, kNoNumber, kNoNumber, values.size()};
  Dice dice(seed);
  std::vector<double> means(kSamples);
  for (double& sampled : means) sampled = mean_of_sample(values, dice);
  std::ranges::sort(means);
  return {mean, percentile(means, 0.025), percentile(means, 0.975), values.size()};
}

Spread spread(std::span<const double> values) {
  if (values.empty()) return {kNoNumber, kNoNumber, 0};
  const double count = static_cast<double>(values.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : values) mean += value / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, values.size() < 2 ? 0.0 : squares / (count - 1.0), values.size()};
}

double student_tail(double t, double degrees) {
  const double beyond = 0.5 * incomplete_beta(degrees / (degrees + t * t), 0.5 * degrees, 0.5);
  return t >= 0.0 ? beyond : 1.0 - beyond;
}

double chance_of_rise(const Spread& a, const Spread& b) {
  if (a.count == 0 || b.count == 0 || (a.count < 2 && b.count < 2)) return kNoNumber;
  // A side with a single value gets the variance of the other side.
  const double variance_a = a.count < 2 ? b.variance : a.variance, variance_b = b.count < 2 ? a.variance : b.variance;
  const double of_a = variance_a / static_cast<double>(a.count), of_b = variance_b / static_cast<double>(b.count);
  const double rise = b.mean - a.mean;
  // Scatter below the rounding error of the mean counts as none.
  const double nothing = 1e-12 * std::max(std::abs(a.mean), std::abs(b.mean));
  if (std::sqrt(of_a + of_b) <= nothing) return rise > nothing ? 0.0 : 1.0;
  const auto share = [](double of, std::size_t count) {
    return count < 2 ? 0.0 : of * of / static_cast<double>(count - 1);
  };
  const double degrees = a.count < 2   ? static_cast<double>(b.count - 1)
                         : b.count < 2 ? static_cast<double>(a.count - 1)
                                       : (of_a + of_b) * (of_a + of_b) / (share(of_a, a.count) + share(of_b, b.count));
  return student_tail(rise / std::sqrt(of_a + of_b), degrees);
}

}  // namespace azimuth
