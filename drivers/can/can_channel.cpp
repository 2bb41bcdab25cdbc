#include "drivers/can/can_channel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kFasterThanPossible = 1.5;  // multiple of the robot's limits beyond which a step is not believed
constexpr double kLeast_s = 0.01;            // shortest assumed time, because delayed frames arrive in a burst
constexpr double kInsane = 1e9;              // magnitude of an implausible float, in metres, m/s or radians
constexpr double kRounding_units = 2.0;
constexpr double kNearZero = 0.03;       // a value below this many metres counts as zero
constexpr double kCycleLearning = 0.05;  // relative change per value
constexpr double kGap_cycles = 2.5;
constexpr double kMayAccelerate_m_s2 = 0.5;  // standard deviation of the acceleration

}  // namespace

double CanChannel::range() const {
  if (motion_.signal.number == CanNumber::ieee_float) return std::numeric_limits<double>::infinity();
  return std::abs(std::ldexp(motion_.signal.scale * motion_.unit, motion_.signal.bits.length_bits));
}

double CanChannel::step(const CanValue& newer, const CanValue& older) const {
  const double by_bits = motion_.unit * difference(motion_.signal, newer, older);
  if (quantity_ != CanQuantity::heading) return by_bits;
  // The first value is right for a base that wraps its heading at a turn, the second for one whose counter wraps
  // elsewhere.
  const double by_turn_rad = wrap(std::remainder(motion_.unit * (newer.value - older.value), 2.0 * kPi));
  const double by_bits_rad = std::remainder(by_bits, 2.0 * kPi);
  return std::abs(by_bits_rad) < std::abs(by_turn_rad) ? by_bits_rad : by_turn_rad;
}

bool CanChannel::is_possible(double step, double elapsed_s) const {
  const double rounding = kRounding_units * std::abs(motion_.signal.scale * motion_.unit);
  const double rounded = motion_.signal.number == CanNumber::ieee_float ? 0.0 : rounding;
  return std::abs(step) <= kFasterThanPossible * motion_.fastest_per_s * std::max(elapsed_s, kLeast_s) + rounded;
}

/// True: after a silence, the counter may have wrapped unnoticed, or the base was switched off and on.
bool CanChannel::has_begun_anew(const CanValue& value, double elapsed_s) const {
  if (quantity_ != CanQuantity::way || elapsed_s <= stale_s_) return false;
  if (motion_.fastest_per_s * elapsed_s > 0.5 * range()) return true;
  const double shown_m = std::abs(motion_.unit * value.value);
  return shown_m < kNearZero && std::abs(motion_.unit * newest_->value.value) > kNearZero;
}

bool CanChannel::is_sane(const CanValue& value) const {
  return motion_.signal.number != CanNumber::ieee_float || std::abs(motion_.unit * value.value) < kInsane;
}

CanChannel::Taken CanChannel::add(const CanValue& value, time_point at) {
  if (!newest_) {
    begin(value, at);
    return Taken::used;
  }
  const double elapsed_s = in_seconds(at - newest_->at);
  if (quantity_ == CanQuantity::speed) return add_speed(value, at, elapsed_s);
  if (has_begun_anew(value, elapsed_s)) return Taken::restarted;
  const double moved = step(value, newest_->value);
  if (!is_possible(moved, elapsed_s)) return doubt(value, at);
  if (motion_.fastest_per_s * elapsed_s > 0.5 * range()) sigma_ = std::hypot(sigma_, range());
  if (!std::exchange(restored_, false)) follow_cycle(elapsed_s, 0.0, 0.0);
  doubtful_.reset();
  before_ = std::exchange(newest_, Point{value, at, newest_->quantity + moved});
  return Taken::used;
}

CanChannel::Taken CanChannel::add_speed(const CanValue& value, time_point at, double elapsed_s) {
  const double from_m_s = motion_.unit * newest_->value.value, to_m_s = motion_.unit * value.value;
  if (std::abs(to_m_s) > kFasterThanPossible * motion_.fastest_per_s) {
    ++doubted_;
    return Taken::doubted;
  }
  if (elapsed_s > stale_s_) return Taken::restarted;
  follow_cycle(elapsed_s, from_m_s, to_m_s);
  const double moved_m = 0.5 * (from_m_s + to_m_s) * elapsed_s;
  before_ = std::exchange(newest_, Point{value, at, newest_->quantity + moved_m});
  return Taken::used;
}

CanChannel::Taken CanChannel::doubt(const CanValue& value, time_point at) {
  ++doubted_;
  const bool again = doubtful_ && is_possible(step(value, doubtful_->value), in_seconds(at - doubtful_->at));
  if (again) return Taken::restarted;
  doubtful_ = Point{value, at, 0.0};
  return Taken::doubted;
}

void CanChannel::begin(const CanValue& value, time_point at) {
  forget();
  // The base's coordinates depend on its heading, so the heading must start with the base's own value.
  newest_ = Point{value, at, quantity_ == CanQuantity::heading ? motion_.unit * value.value : 0.0};
}

std::optional<CanChannel::Memory> CanChannel::memory() const { return newest_; }

void CanChannel::restore(const Memory& memory) {
  forget();
  newest_ = memory;
  restored_ = true;
}

void CanChannel::forget() {
  restored_ = false;
  newest_.reset();
  before_.reset();
  doubtful_.reset();
  sigma_ = 0.0;
}

/// Learns the time between values as their median, which lost frames and bursts hardly change.
void CanChannel::follow_cycle(double elapsed_s, double from, double to) {
  if (elapsed_s <= 0.0) return;
  if (cycle_s_ == 0.0) cycle_s_ = elapsed_s;
  if (elapsed_s > kGap_cycles * cycle_s_) {
    missed_ += static_cast<std::uint64_t>(std::llround(elapsed_s / cycle_s_)) - 1;
    sigma_ = std::hypot(sigma_, gap_sigma(elapsed_s, from, to));
  }
  cycle_s_ *= elapsed_s > cycle_s_ ? 1.0 + kCycleLearning : 1.0 - kCycleLearning;
}

/// The uncertainty of a gap. A counter shows the whole motion. For a speed only the values at both ends are known: in
/// between the robot may have kept either speed, or accelerated.
double CanChannel::gap_sigma(double elapsed_s, double from, double to) const {
  if (quantity_ != CanQuantity::speed) return 0.0;
  const double sigma_m = 0.5 * std::abs(to - from) * elapsed_s + 0.25 * kMayAccelerate_m_s2 * elapsed_s * elapsed_s;
  return std::min(sigma_m, motion_.fastest_per_s * elapsed_s);
}

std::optional<CanChannel::time_point> CanChannel::newest_at() const {
  return newest_ ? std::optional(newest_->at) : std::nullopt;
}

std::optional<double> CanChannel::at(time_point instant) const {
  if (!newest_) return std::nullopt;
  if (instant == newest_->at) return newest_->quantity;
  if (instant > newest_->at || !before_ || instant < before_->at) return std::nullopt;
  const double part = in_seconds(instant - before_->at) / in_seconds(newest_->at - before_->at);
  return before_->quantity + part * (newest_->quantity - before_->quantity);
}

double CanChannel::take_sigma() { return std::exchange(sigma_, 0.0); }

}  // namespace azimuth
