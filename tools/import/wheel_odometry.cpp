#include "tools/import/wheel_odometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "slam/geometry/angle.hpp"
#include "tools/import/wheel_path.hpp"

namespace azimuth {
namespace {

struct CounterRange {
  double counts;
  const char* name;
};
/// Common ranges of wheel counters. Counters of hoverboards end at 8999, those of resolvers at 3599.
constexpr std::array<CounterRange, 19> kRanges{{{2.0 * kPi, "a full turn"},
                                                {256, "256 (8 bits)"},
                                                {360, "360 (a full turn)"},
                                                {1000, "1000"},
                                                {1024, "1024 (10 bits)"},
                                                {2048, "2048 (11 bits)"},
                                                {3600, "3600"},
                                                {4096, "4096 (12 bits)"},
                                                {8192, "8192 (13 bits)"},
                                                {9000, "9000"},
                                                {10000, "10000"},
                                                {16384, "16384 (14 bits)"},
                                                {32768, "32768 (15 bits)"},
                                                {36000, "36000"},
                                                {65536, "65536 (16 bits)"},
                                                {100000, "100000"},
                                                {1048576, "1048576 (20 bits)"},
                                                {16777216, "16777216 (24 bits)"},
                                                {4294967296.0, "4294967296 (32 bits)"}}};

/// Steps below kPlain times the range are real; steps above kWrapped times the range are wraps. Steps in between are
/// ambiguous.
constexpr double kPlain = 0.25, kWrapped = 0.75;
constexpr double kRounding = 1e-6;
/// Least number of readings for which a range is determined. A wrap in every kSeldom-th reading is too frequent.
constexpr std::size_t kFewest = 10, kSeldom = 2;
// A step through the wrap must not be much faster than the neighbouring steps.
constexpr std::size_t kNear = 5;
constexpr double kFaster = 2.0, kRoom = 0.003, kRoom_m = 0.02;
// Conditions for a range that is not among kRanges.
constexpr std::size_t kWrapsThatAgree = 3;
constexpr double kAgree = 0.02;

double span_of(const std::vector<double>& counts) {
  const auto [least, most] = std::ranges::minmax(counts);
  return most - least;
}

/// Largest distance that counts as zero after a restart, since the wheels may roll before the first reading.
constexpr double kZero_m = 0.1;
/// Largest number of jumps, or one in so many readings, that may be exceptions.
constexpr std::size_t kMostJumps = 3, kMostIn = 20;

bool is_at_zero(const WheelReading& reading) {
  return std::abs(reading.left_m) <= kZero_m && std::abs(reading.right_m) <= kZero_m;
}

struct NamedWheel {
  const char* name;
  WheelCounter counter;
};

NamedWheel wheel(const char* name, const std::vector<WheelReading>& readings, double WheelReading::*rolled_m,
                 double count_m) {
  std::vector<Stamp> stamps;
  std::vector<double> counts;
  for (const WheelReading& reading : readings) {
    stamps.push_back(reading.stamp);
    counts.push_back(reading.*rolled_m / count_m);
    // Counts that were recorded as integers become integers again.
    if (const double whole = std::round(counts.back()); std::abs(counts.back() - whole) < 1e-9 * std::abs(whole))
      counts.back() = whole;
  }
  return {name, WheelCounter(std::move(stamps), std::move(counts), count_m)};
}

double since_s(const std::vector<WheelReading>& readings, std::size_t index) {
  return to_seconds(readings[index].stamp - readings.front().stamp);
}

std::string too_narrow(const NamedWheel& wheel, double range) {
  return fmt::format(
      "the {} wheel stays within {} and steps through more than half of that: a counter that wraps, and nobody can "
      "tell which way it went: record it more often, or what the wheel has rolled in all",
      wheel.name, range_text(range));
}

std::string no_wheel_does(const NamedWheel& wheel, const WheelCounter::Jump& jump, double at_s, std::size_t jumps) {
  return fmt::format(
      "the {} wheel steps by {:g} counts ({:.2f} m) {:.1f} s after its first reading, which no wheel does{}: a counter "
      "that wraps in a range which is not plain, or damaged readings? Unwrap or mend it before, or cut the recording "
      "there",
      wheel.name, wheel.counter.step(jump.index), jump.jump.step_m, at_s,
      jumps > 1 ? fmt::format(" (and {} times more)", jumps - 1) : "");
}

/// Unwraps both counters and adds notes. Returns an error text, or an empty text.
std::string unwrap(std::array<NamedWheel, 2>& wheels, std::vector<std::string>& notes) {
  for (auto& [name, counter] : wheels) {
    if (const std::optional<double> range = counter.range()) {
      const std::size_t times = counter.unwrap(*range);
      notes.push_back(fmt::format("the {} wheel's counter wraps at {}: unwrapped {} {}", name, range_text(*range),
                                  times, times == 1 ? "time" : "times"));
    } else if (const std::optional<double> narrow = counter.range_too_narrow()) {
      return too_narrow({name, counter}, *narrow);
    }
  }
  return {};
}

}  // namespace

std::string range_text(double range) {
  const auto known = std::ranges::find(kRanges, range, &CounterRange::counts);
  return known != kRanges.end() ? known->name : fmt::format("{:g}", range);
}

WheelCounter::WheelCounter(std::vector<Stamp> stamps, std::vector<double> counts, double count_m)
    : stamps_(std::move(stamps)),
      counts_(std::move(counts)),
      count_m_(count_m),
      span_(span_of(counts_)),
      are_whole_(std::ranges::all_of(counts_, [](double count) { return count == std::round(count); })) {
  for (std::size_t i = 1; i < counts_.size(); ++i) longest_step_ = std::max(longest_step_, std::abs(step(i)));
}

double WheelCounter::elapsed_s(std::size_t index) const { return to_seconds(stamps_[index] - stamps_[index - 1]); }

/// The step to a reading, corrected for a wrap.
double WheelCounter::wrapped(std::size_t index, double range) const {
  const double plain = step(index);
  return std::abs(plain) > kWrapped * range ? plain - std::copysign(range, plain) : plain;
}

/// Speed of the neighbouring steps of at most `longest` counts, in counts per second: the largest magnitude or the
/// mean.
double WheelCounter::speed_near(std::size_t index, double longest, bool fastest) const {
  double sum = 0.0, most = 0.0;
  int count = 0;
  const std::size_t begin = index > kNear ? index - kNear : 1, end = std::min(counts_.size(), index + kNear + 1);
  for (std::size_t i = begin; i < end; ++i) {
    if (i == index || std::abs(step(i)) > longest) continue;
    const double speed = step(i) / elapsed_s(i);
    sum += speed;
    most = std::max(most, std::abs(speed));
    ++count;
  }
  return fastest ? most : count > 0 ? sum / count : 0.0;
}

/// True if all counts fit into the range. Integer counts reach at most the range minus one.
bool WheelCounter::may_be(double range) const {
  return span_ <= (are_whole_ ? range - 1.0 : range * (1.0 + kRounding));
}

bool WheelCounter::fits(double range) const {
  if (!may_be(range) || longest_step_ <= kWrapped * range || counts_.size() < kFewest) return false;
  std::size_t wraps = 0;
  for (std::size_t i = 1; i < counts_.size(); ++i) {
    const double length = std::abs(step(i));
    if (length > kPlain * range && length <= kWrapped * range) return false;
    if (length <= kWrapped * range) continue;
    const double room = kRoom * range + kRoom_m / std::abs(count_m_);
    const double possible = kFaster * speed_near(i, kPlain * range, true) * elapsed_s(i) + room;
    if (std::abs(wrapped(i, range)) > std::min(possible, kPlain * range)) return false;
    ++wraps;
  }
  return kSeldom * wraps < counts_.size();
}

/// Sum of the differences between steps through the wrap and the steps that neighbouring speeds predict.
double WheelCounter::misfit(double range) const {
  double sum = 0.0;
  for (std::size_t i = 1; i < counts_.size(); ++i)
    if (std::abs(step(i)) > kWrapped * range)
      sum += std::abs(wrapped(i, range) - speed_near(i, kPlain * range, false) * elapsed_s(i));
  return sum;
}

std::optional<double> WheelCounter::range() const {
  std::optional<double> best;
  for (const CounterRange& each : kRanges)
    if (fits(each.counts) && (!best || misfit(each.counts) < misfit(*best))) best = each.counts;
  return best ? best : agreed_range();
}

/// The range as the mean of the estimates from each wrap, if these agree.
std::optional<double> WheelCounter::agreed_range() const {
  if (jumps().size() < kWrapsThatAgree) return std::nullopt;
  const double wrap = kWrapped * span_;
  double sum = 0.0, least = 0.0, most = 0.0;
  std::size_t wraps = 0;
  for (std::size_t i = 1; i < counts_.size(); ++i) {
    if (std::abs(step(i)) <= wrap) continue;
    const double went = speed_near(i, kPlain * span_, false) * elapsed_s(i);
    const double range = std::abs(went - step(i));
    least = wraps == 0 ? range : std::min(least, range);
    most = std::max(most, range);
    sum += range;
    ++wraps;
  }
  if (wraps < kWrapsThatAgree || most - least > kAgree * most) return std::nullopt;
  const double mean = sum / static_cast<double>(wraps);
  const double range = are_whole_ ? std::max(std::round(mean), span_ + 1.0) : std::max(mean, span_);
  return fits(range) ? std::optional(range) : std::nullopt;
}

std::optional<double> WheelCounter::range_too_narrow() const {
  constexpr double kNearlyAll = 0.95;
  constexpr std::size_t kEnough = 20, kOften = 3;
  if (counts_.size() < kEnough) return std::nullopt;
  for (const CounterRange& each : kRanges) {
    const bool is_within = span_ > kNearlyAll * each.counts && may_be(each.counts);
    std::size_t wide = 0;
    for (std::size_t i = 1; i < counts_.size(); ++i) wide += std::abs(step(i)) > 0.5 * each.counts ? 1 : 0;
    if (is_within && wide >= std::max(kOften, counts_.size() / kEnough)) return each.counts;
  }
  return std::nullopt;
}

std::size_t WheelCounter::unwrap(double range) {
  std::size_t wraps = 0;
  double added = 0.0, before = counts_.front();
  for (double& count : counts_) {
    const double plain = count - before;
    before = count;
    if (std::abs(plain) > kWrapped * range) {
      added -= std::copysign(range, plain);
      ++wraps;
    }
    count += added;
  }
  return wraps;
}

std::vector<WheelCounter::Jump> WheelCounter::jumps() const {
  OdometrySteps steps;
  std::vector<Jump> jumps;
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (const auto jump = steps.next({.stamp = stamps_[i], .T_odom_body = {rolled_m(i), 0.0, 0.0}}))
      jumps.push_back({i, *jump});
  return jumps;
}

FileResult<std::vector<OdometryReading>> wheel_odometry(std::vector<WheelReading> readings, const WheelCounts& counts,
                                                        double track_m, const std::string& file,
                                                        std::vector<std::string>& notes) {
  std::array<NamedWheel, 2> wheels{wheel("left", readings, &WheelReading::left_m, counts.left_m),
                                   wheel("right", readings, &WheelReading::right_m, counts.right_m)};
  if (std::string problem = unwrap(wheels, notes); !problem.empty())
    return failure(FileError{file, 0, std::move(problem)});
  std::vector<const OdometryJump*> restart(readings.size());
  const std::array<std::vector<WheelCounter::Jump>, 2> jumps{wheels[0].counter.jumps(), wheels[1].counter.jumps()};
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    for (const WheelCounter::Jump& jump : jumps[i]) {
      const bool are_frequent = kMostIn * jumps[i].size() > readings.size() && jumps[i].size() > kMostJumps;
      if (!is_at_zero(readings[jump.index]) && (are_frequent || wheels[i].counter.is_most_of_all(jump.index)))
        return failure(
            FileError{file, 0, no_wheel_does(wheels[i], jump, since_s(readings, jump.index), jumps[i].size())});
      restart[jump.index] = &jump.jump;
    }
  }
  WheelPath path(track_m);
  std::vector<OdometryReading> odometry;
  std::uint32_t origin = 0;
  double left_m = 0.0, right_m = 0.0;  // distances since the first reading, without unknown motions
  for (std::size_t i = 0; i < readings.size(); ++i) {
    OdometryReading reading{.stamp = readings[i].stamp, .sequence = i, .T_odom_body = {}};
    if (const OdometryJump* const jump = restart[i]) {
      ++origin;
      reading.sigma_gap_m = jump->sigma_m;
      reading.sigma_gap_rad = std::min(kPi, std::sqrt(2.0) * jump->sigma_m / track_m);
    } else if (i > 0) {
      left_m += wheels[0].counter.rolled_m(i) - wheels[0].counter.rolled_m(i - 1);
      right_m += wheels[1].counter.rolled_m(i) - wheels[1].counter.rolled_m(i - 1);
    }
    reading.T_odom_body = path.at(left_m, right_m);
    reading.origin = origin;
    odometry.push_back(reading);
  }
  return odometry;
}

}  // namespace azimuth
