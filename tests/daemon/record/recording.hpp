#pragma once
// The samples that the tests feed to the recorder, and functions that read them back.

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "daemon/record/recorder.hpp"
#include "drivers/storage/run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth::test {

using namespace std::chrono_literals;

inline constexpr auto kReadingInterval = 10ms;

/// Reading `number` of a robot that drives on. Every reading differs from every other in all its numbers.
inline OdometryReading reading(std::uint64_t number) {
  const auto n = static_cast<double>(number);
  return {.stamp = stamp_from_us(1'700'000'000'000'000 + 10'000 * static_cast<std::int64_t>(number)),
          .sequence = number,
          .T_odom_body = {n / 3.0, n / 7.0, 1.0 / (n + 1.0)}};
}

inline BearingSet bearing_set(std::uint64_t number, std::size_t bearings = 3) {
  return {reading(number).stamp, number, std::vector<Bearing>(bearings, {0.1, 0.2, 4})};
}

inline std::vector<Document> documents() {
  return {{"rig.toml", "front_end = \"bearings\"\n"}, {"azimuth.toml", "estimator = \"ekf\"\n"}, {"version", "1.2.3"}};
}

/// A recorder in virtual time, fed with one reading every kReadingInterval.
class Feeder {
 public:
  explicit Feeder(const RecordSettings& settings, EventTimes times = EventTimes::of_recording(Stamp{}))
      : recorder_(settings, documents(), times) {
    recorder_.turn(now_);
  }

  /// Feeds the next `count` readings, and a bearing set with every tenth of them.
  void feed(std::uint64_t count) {
    for (const std::uint64_t end = next_ + count; next_ < end; ++next_) {
      recorder_.odometry(reading(next_));
      if (next_ % 10 == 0) recorder_.bearings(bearing_set(next_));
      now_ += kReadingInterval;
      recorder_.turn(now_);
    }
  }
  /// Lets time pass without samples.
  void wait(std::chrono::milliseconds duration) {
    for (const auto end = now_ + duration; now_ < end;) recorder_.turn(now_ += 100ms);
  }
  std::uint64_t fed() const { return next_ + (next_ + 9) / 10; }  ///< Number of events so far
  std::uint64_t readings() const { return next_; }
  Recorder& recorder() { return recorder_; }
  const RecorderStatus& status() const { return recorder_.status(); }

 private:
  Recorder recorder_;
  Recorder::Clock::time_point now_ = Recorder::Clock::time_point(1000h);
  std::uint64_t next_ = 0;
};

/// The sessions in a recording folder, sorted by name.
inline std::vector<std::filesystem::path> sessions(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

inline Run load(const std::filesystem::path& path, const LogOptions& options = {}) {
  FileResult<Run> run = load_run(path, options);
  if (!run) throw std::runtime_error(text(run.error()));
  return *std::move(run);
}

}  // namespace azimuth::test
