#include "sim/pioneer/fault_schedule.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <fmt/format.h>
#include <utility>

namespace azimuth::sim {
namespace {

constexpr double kLongest_s = 1e9;

}  // namespace

tl::expected<TimedFault, std::string> parse_timed_fault(std::string_view text) {
  double at_s = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), at_s);
  const auto rest = text.substr(static_cast<std::size_t>(end - text.data()));
  const bool in_range = at_s >= 0.0 && at_s <= kLongest_s;
  if (error != std::errc() || !rest.starts_with(':') || !in_range) {
    return tl::unexpected(fmt::format("\"{}\" is not SECONDS:FAULT", text));
  }
  return parse_fault(rest.substr(1)).map([&](const Fault& fault) {
    return TimedFault{Stamp(duration_from_seconds(at_s)), fault};
  });
}

FaultSchedule::FaultSchedule(std::vector<TimedFault> once, std::vector<Fault> cycle, Duration period)
    : once_(std::move(once)), cycle_(std::move(cycle)), period_(period), next_cycle_at_(period) {
  assert(cycle_.empty() || period_ > Duration{});
  std::ranges::stable_sort(once_, {}, &TimedFault::at);
}

Stamp FaultSchedule::due() const { return std::min(once_due(), cycle_due()); }

std::vector<Fault> FaultSchedule::take(Stamp now) {
  std::vector<Fault> faults;
  while (due() <= now) faults.push_back(take_one());
  return faults;
}

Fault FaultSchedule::take_one() {
  if (once_due() <= cycle_due()) return once_[next_once_++].fault;
  const Fault& fault = cycle_[next_in_cycle_];
  next_in_cycle_ = (next_in_cycle_ + 1) % cycle_.size();
  next_cycle_at_ += period_;
  return fault;
}

}  // namespace azimuth::sim
