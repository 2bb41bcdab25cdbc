#include "drivers/fifo/fifo_odometer.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <utility>

#include "drivers/wire/number_text.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

constexpr double kMaxStamp_s = 1e11, kMaxAge_s = 1.0, kMaxLead_s = 0.01;
constexpr std::size_t kLongestLine = 120;
constexpr DeviceClock::duration kFirstBackOff = std::chrono::milliseconds(50),
                                kLongestBackOff = std::chrono::seconds(1);

}  // namespace

std::optional<OdometryReading> parse_fifo_line(std::string_view line) {
  std::array<double, 4> numbers{};
  if (line.ends_with('\r')) line.remove_suffix(1);
  if (line.size() > kLongestLine || std::ranges::count(line, ',') != 3) return std::nullopt;
  for (double& number : numbers) {
    const std::string_view field = line.substr(0, line.find(','));
    line.remove_prefix(std::min(field.size() + 1, line.size()));
    const std::optional<double> parsed = parse_double(field);
    if (!parsed) return std::nullopt;
    number = *parsed;
  }
  OdometryReading reading;
  reading.T_odom_body = {numbers[1], numbers[2], numbers[3]};
  if (!(std::abs(numbers[0]) < kMaxStamp_s) || !is_plausible(reading.T_odom_body)) return std::nullopt;
  reading.T_odom_body.heading_rad = wrap(numbers[3]);
  reading.stamp += duration_from_seconds(numbers[0]);
  return reading;
}

FifoOdometer::FifoOdometer(FifoSettings settings, Duration epoch_minus_monotonic)
    : settings_(std::move(settings)),
      epoch_minus_monotonic_(epoch_minus_monotonic),
      back_off_(kFirstBackOff, kLongestBackOff),
      news_("odometry comes from " + settings_.path) {
  line_.reserve(kLongestLine + 1);
}

FifoOdometer::Clock::duration FifoOdometer::due_in(Clock::time_point now) const {
  if (state_.connection == Connection::silent) return Clock::duration::max();
  return std::max(Clock::duration{},
                  (fifo_ ? last_reading_ + clock_duration(settings_.silent_s) : back_off_.due()) - now);
}

void FifoOdometer::turn(Clock::time_point now) {
  if (!fifo_ && back_off_.is_due(now)) open(now);
  std::array<char, 4096> bytes{};
  const ssize_t got = fifo_ ? ::read(fifo_.get(), bytes.data(), bytes.size()) : -1;
  for (const char byte : std::string_view(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)))) {
    if (byte == '\n') accept(now);
    if (byte != '\n' && line_.size() <= kLongestLine) line_ += byte;
  }
  // At 0 no process has the FIFO open for writing. A descriptor that was hung up would wake the thread for ever.
  if (got == 0) open(now);
  watch_silence(now);
}

/// The old descriptor is closed last, so that a writer that comes meanwhile always finds a reader.
void FifoOdometer::open(Clock::time_point now) {
  const char* const path = settings_.path.c_str();
  // The mode is set again regardless of the umask, because other users must be able to write.
  if (::mkfifo(path, 0660) == 0) static_cast<void>(::chmod(path, 0660));
  UniqueFd opened(::open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  const int error = errno;
  struct stat status {};
  const bool is_fifo = opened && ::fstat(opened.get(), &status) == 0 && S_ISFIFO(status.st_mode);
  const std::string trouble = opened ? "is no FIFO" : std::generic_category().message(error);
  fifo_ = is_fifo ? std::move(opened) : UniqueFd();
  is_new_writer_ = true;
  line_.clear();
  if (!is_fifo) {
    back_off_.failed(now);
    news_.enter(Connection::away, settings_.path + ": " + trouble, state_);
  } else if (state_.connection == Connection::away) {
    back_off_.succeeded();
    last_reading_ = now;
    news_.enter(Connection::starting, {}, state_);
  }
}

void FifoOdometer::accept(Clock::time_point now) {
  std::optional<OdometryReading> reading = parse_fifo_line(line_);
  line_.clear();
  if (!reading) return refuse("not stamp_s,x_m,y_m,heading_rad");
  const double age_s = to_seconds(stamp_at(now) - reading->stamp);
  if (age_s > kMaxAge_s || age_s < -kMaxLead_s) return refuse("not stamped by CLOCK_MONOTONIC");
  reading->stamp += epoch_minus_monotonic_;
  if (reading->stamp <= newest_) return refuse("out of order");
  if (std::exchange(is_new_writer_, false)) {
    steps_ = OdometrySteps();
    ++origin_;
  }
  const std::optional<OdometryJump> jump = steps_.next(*reading);
  if (jump && !steps_.are_frequent()) {
    ++origin_;
    reading->sigma_gap_m = jump->sigma_m;
    reading->sigma_gap_rad = jump->sigma_rad;
  }
  reading->origin = origin_;
  reading->sequence = ++sequence_;
  newest_ = reading->stamp;
  readings_.push(*reading);
  last_reading_ = now;
  news_.enter(Connection::running, {}, state_);
}

void FifoOdometer::refuse(std::string_view why) {
  ++state_.refused;
  state_.refusal = why;
}

/// A FIFO without a writer counts as silent as well.
void FifoOdometer::watch_silence(Clock::time_point now) {
  if (!fifo_ || state_.connection == Connection::silent) return;
  if (now - last_reading_ >= clock_duration(settings_.silent_s))
    news_.enter(Connection::silent, settings_.path + ": no odometry", state_);
}

}  // namespace azimuth
