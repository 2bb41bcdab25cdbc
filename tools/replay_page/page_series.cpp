#include "tools/replay_page/page_series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "tools/evaluate/pose_error.hpp"
#include "tools/evaluate/statistics.hpp"

namespace azimuth {
namespace {

constexpr double kMillimetre = 1e-3, kTenthMilliradian = 1e-4;
constexpr double kNisWindow_s = 10.0;

/// Columns of equal length, initialised to NaN.
class Columns {
 public:
  explicit Columns(std::size_t steps) : steps_(steps) {}

  std::vector<double>& add(std::string_view name, double unit = 0.0, bool keeps_peaks = false) {
    columns_.push_back({name, unit, keeps_peaks, std::vector<double>(steps_, kNotMeasured)});
    return columns_.back().values;
  }
  std::vector<PageColumn> take() { return std::move(columns_); }

 private:
  std::size_t steps_;
  std::vector<PageColumn> columns_;
};

/// Sets one value per step.
template <class Of>
void fill(std::vector<double>& values, Of of) {
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = of(i);
}

/// Adds three columns with the poses of all steps.
template <class PoseOf>
void add_poses(std::array<std::string_view, 3> names, bool keeps_peaks, PoseOf pose, Columns& columns) {
  fill(columns.add(names[0], kMillimetre, keeps_peaks), [&](std::size_t i) { return pose(i).x_m; });
  fill(columns.add(names[1], kMillimetre, keeps_peaks), [&](std::size_t i) { return pose(i).y_m; });
  fill(columns.add(names[2], kTenthMilliradian), [&](std::size_t i) { return pose(i).heading_rad; });
}

void add_paths(const std::vector<EstimateRecord>& estimates, Columns& columns) {
  const Stamp first = estimates.front().stamp;
  fill(columns.add("t", kMillimetre), [&](std::size_t i) { return to_seconds(estimates[i].stamp - first); });
  add_poses(
      {"x", "y", "heading"}, true, [&](std::size_t i) { return estimates[i].T_map_body; }, columns);
  const Pose2 T_map_odom = estimates.front().T_map_body * inverse(estimates.front().T_odom_body);
  const auto by_odometry = [&](std::size_t i) { return T_map_odom * estimates[i].T_odom_body; };
  add_poses({"odometry_x", "odometry_y", "odometry_heading"}, false, by_odometry, columns);
  fill(columns.add("xx"), [&](std::size_t i) { return estimates[i].covariance(0, 0); });
  fill(columns.add("xy"), [&](std::size_t i) { return estimates[i].covariance(0, 1); });
  fill(columns.add("yy"), [&](std::size_t i) { return estimates[i].covariance(1, 1); });
}

std::vector<PosePair> pairs_of(const Run& run, const std::vector<EstimateRecord>& estimates) {
  std::vector<StampedPose> estimated, truth;
  for (const EstimateRecord& estimate : estimates) estimated.push_back({estimate.stamp, estimate.T_map_body});
  for (const TruthPose& pose : run.truth) truth.push_back({pose.stamp, pose.T_world_body});
  return pair_with_truth(estimated, truth);
}

void add_truth(const std::vector<PosePair>& pairs, const Report& report, Columns& columns) {
  if (!report.T_world_map) return;
  const Pose2 T_map_world = inverse(*report.T_world_map);
  constexpr double kNone = kNotMeasured;
  std::vector<Pose2> truth(report.steps, Pose2{kNone, kNone, kNone});
  std::vector<double> off_m(report.steps, kNone);
  for (const PosePair& pair : pairs) {
    truth[pair.index] = T_map_world * pair.T_world_body;
    off_m[pair.index] = (truth[pair.index].position() - pair.estimated.position()).norm();
  }
  add_poses(
      {"truth_x", "truth_y", "truth_heading"}, false, [&](std::size_t i) { return truth[i]; }, columns);
  columns.add("off", 0.0, true) = std::move(off_m);
}

void add_two_sigma(const std::vector<EstimateRecord>& estimates, const std::vector<RelativeError>& errors,
                   Columns& columns) {
  constexpr std::array<std::string_view, 3> kNames{"two_sigma_x", "two_sigma_y", "two_sigma_heading"};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& values = columns.add(kNames[static_cast<std::size_t>(axis)], 0.0, true);
    if (errors.empty())
      fill(values, [&](std::size_t i) { return 2.0 * std::sqrt(estimates[i].covariance(axis, axis)); });
    for (const RelativeError& error : errors) values[error.index] = 2.0 * std::sqrt(error.covariance(axis, axis));
  }
}

void add_errors(const std::vector<EstimateRecord>& estimates, const std::vector<RelativeError>& errors,
                Columns& columns) {
  constexpr std::array<std::string_view, 3> kNames{"error_x", "error_y", "error_heading"};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& values = columns.add(kNames[static_cast<std::size_t>(axis)], 0.0, true);
    for (const RelativeError& error : errors) values[error.index] = error.error[axis];
  }
  std::vector<double> nees(estimates.size(), kNotMeasured), anees = nees;
  double sum = 0.0;
  std::size_t count = 0;
  for (const RelativeError& error : errors) {
    const std::optional<double> squared = normalised_squared(error, estimates[error.index]);
    if (!squared) continue;
    sum += *squared;
    nees[error.index] = *squared;
    anees[error.index] = sum / static_cast<double>(++count);
  }
  columns.add("nees", 0.0, true) = std::move(nees);
  columns.add("anees") = std::move(anees);
}

/// Caches the bounds of the NIS mean by number of bearings, since the same numbers recur.
class MeanBounds {
 public:
  std::pair<double, double> of(std::size_t compared) {
    const auto [found, is_new] = bounds_.try_emplace(compared);
    const auto count = static_cast<double>(compared);
    if (is_new) found->second = {chi2_quantile(0.025, compared) / count, chi2_quantile(0.975, compared) / count};
    return found->second;
  }

 private:
  std::map<std::size_t, std::pair<double, double>> bounds_;
};

/// Mean NIS of the bearings compared within kNisWindow_s before each step.
std::vector<double> recent_nis(const std::vector<EstimateRecord>& estimates, std::span<const PageStep> steps) {
  std::vector<double> means(steps.size(), kNotMeasured);
  double sum = 0.0;
  std::size_t compared = 0, oldest = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    sum += steps[i].nis;
    compared += steps[i].compared;
    for (; to_seconds(estimates[i].stamp - estimates[oldest].stamp) > kNisWindow_s; ++oldest) {
      sum -= steps[oldest].nis;
      compared -= steps[oldest].compared;
    }
    if (compared > 0) means[i] = std::max(0.0, sum) / static_cast<double>(compared);
  }
  return means;
}

void add_innovations(const std::vector<EstimateRecord>& estimates, std::span<const PageStep> steps, Columns& columns) {
  const std::size_t count = steps.size();
  std::vector<double> mean(count, kNotMeasured), low = mean, high = mean;
  MeanBounds bounds;
  for (std::size_t i = 0; i < count; ++i) {
    if (steps[i].compared == 0) continue;
    mean[i] = steps[i].nis / static_cast<double>(steps[i].compared);
    std::tie(low[i], high[i]) = bounds.of(steps[i].compared);
  }
  columns.add("nis", 0.0, true) = std::move(mean);
  columns.add("nis_low") = std::move(low);
  columns.add("nis_high") = std::move(high);
  columns.add("nis_recent", 0.0, true) = recent_nis(estimates, steps);
}

void add_counts(std::span<const PageStep> steps, Columns& columns) {
  const auto add = [&](std::string_view name, auto of) {
    fill(columns.add(name, 1.0), [&](std::size_t i) { return static_cast<double>(of(steps[i])); });
  };
  add("seen", [](const PageStep& step) { return step.seen; });
  add("accepted", [](const PageStep& step) { return step.counts.accepted; });
  add("rejected", [](const PageStep& step) { return step.counts.rejected; });
  add("ambiguous", [](const PageStep& step) { return step.counts.ambiguous; });
  add("thinned", [](const PageStep& step) { return step.counts.thinned; });
  add("created", [](const PageStep& step) { return step.counts.created; });
}

}  // namespace

std::vector<PageColumn> page_series(const Run& run, const ReplayResult& result, const Report& report,
                                    std::span<const PageStep> steps) {
  const std::vector<EstimateRecord>& estimates = result.estimates;
  if (estimates.empty()) return {};
  const std::vector<PosePair> pairs = pairs_of(run, estimates);
  const std::vector<RelativeError> errors = relative_errors(pairs, estimates);
  Columns columns(estimates.size());
  add_paths(estimates, columns);
  add_truth(pairs, report, columns);
  add_two_sigma(estimates, errors, columns);
  if (!errors.empty()) add_errors(estimates, errors, columns);
  if (steps.size() == estimates.size()) {
    add_innovations(estimates, steps, columns);
    add_counts(steps, columns);
  }
  if (result.times.step_us.size() == estimates.size())
    fill(columns.add("step_us", 0.1, true), [&](std::size_t i) { return result.times.step_us[i]; });
  return columns.take();
}

}  // namespace azimuth
