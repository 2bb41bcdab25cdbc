#include "tools/import/wheel_odometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "tools/import/wheel_counter.hpp"
#include "tools/import/wheel_path.hpp"

namespace azimuth {
namespace {

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
