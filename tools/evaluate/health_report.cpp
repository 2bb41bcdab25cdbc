#include "tools/evaluate/health_report.hpp"

#include <algorithm>

namespace azimuth {
namespace {

constexpr double kShortestGap_s = 1.0, kIntervalsOfAGap = 3.0;

struct Span {
  Stamp first, last;
  double seconds() const { return to_seconds(last - first); }
};

/// The period from the first sample to the last, over steps and odometry.
Span span_of(std::span<const StepHealth> steps, std::span<const DrivenBy> driven) {
  Span span{steps.front().stamp, steps.back().stamp};
  if (driven.empty()) return span;
  return {std::min(span.first, driven.front().stamp), std::max(span.last, driven.back().stamp)};
}

double path_by(std::span<const DrivenBy> driven, Stamp stamp) {
  const auto next = std::ranges::lower_bound(driven, stamp, {}, &DrivenBy::stamp);
  if (next == driven.end()) return driven.empty() ? 0.0 : driven.back().path_m;
  if (next == driven.begin() || next->stamp == stamp) return next->path_m;
  const DrivenBy& before = *std::prev(next);
  const double fraction = to_seconds(stamp - before.stamp) / to_seconds(next->stamp - before.stamp);
  return before.path_m + fraction * (next->path_m - before.path_m);
}

void add_times(std::span<const StepHealth> steps, const Span& run, HealthReport& report) {
  const auto time_of = [&](Health health) -> HealthTime& { return report.times[static_cast<std::size_t>(health)]; };
  time_of(Health::starting).seconds += to_seconds(steps.front().stamp - run.first);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    HealthTime& time = time_of(steps[i].health);
    time.seconds += to_seconds((i + 1 < steps.size() ? steps[i + 1].stamp : run.last) - steps[i].stamp);
    if (steps[i].reason.empty() || !time.first_reason.empty()) continue;
    time.first_reason = steps[i].reason;
    time.first_reason_at_s = to_seconds(steps[i].stamp - run.first);
  }
  for (HealthTime& time : report.times) time.share = run.seconds() > 0.0 ? time.seconds / run.seconds() : 0.0;
}

void count_losses(std::span<const StepHealth> steps, HealthReport& report) {
  bool was_lost = false;
  for (const StepHealth& step : steps) {
    const bool is_lost = step.health == Health::lost;
    report.times_lost += is_lost && !was_lost ? 1 : 0;
    report.times_found += was_lost && !is_lost ? 1 : 0;
    was_lost = is_lost;
  }
}

double gap_limit_s(std::span<const StepHealth> steps) {
  std::vector<double> intervals_s;
  for (std::size_t i = 1; i < steps.size(); ++i) intervals_s.push_back(to_seconds(steps[i].stamp - steps[i - 1].stamp));
  if (intervals_s.empty()) return kShortestGap_s;
  const auto middle = intervals_s.begin() + static_cast<std::ptrdiff_t>(intervals_s.size() / 2);
  std::ranges::nth_element(intervals_s, middle);
  return std::max(kShortestGap_s, kIntervalsOfAGap * *middle);
}

BlindReport blind_report(std::span<const StepHealth> steps, std::span<const DrivenBy> driven, const Span& run) {
  BlindReport report{.driven_m = 0.0, .path_m = path_by(driven, run.last), .gaps = 0, .longest_s = 0.0};
  const double limit_s = gap_limit_s(steps);
  Stamp last_used = run.first;
  const auto end_gap = [&](Stamp stamp) {
    const double gap_s = to_seconds(stamp - last_used);
    report.longest_s = std::max(report.longest_s, gap_s);
    if (gap_s > limit_s) {
      ++report.gaps;
      report.driven_m += path_by(driven, stamp) - path_by(driven, last_used);
    }
    last_used = stamp;
  };
  for (const StepHealth& step : steps)
    if (step.used_bearing) end_gap(step.stamp);
  end_gap(run.last);
  return report;
}

}  // namespace

HealthReport health_report(std::span<const StepHealth> steps, std::span<const DrivenBy> driven) {
  HealthReport report;
  if (steps.empty()) return report;
  const Span run = span_of(steps, driven);
  add_times(steps, run, report);
  count_losses(steps, report);
  report.blind = blind_report(steps, driven, run);
  return report;
}

}  // namespace azimuth
