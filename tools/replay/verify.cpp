#include "tools/replay/verify.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <utility>

namespace azimuth {
namespace {

constexpr std::size_t kNumbers = 15;

constexpr std::array<const char*, kNumbers> kNames{"x_m",           "y_m",           "heading_rad",     "covariance[0]",
                                                   "covariance[1]", "covariance[2]", "covariance[3]",   "covariance[4]",
                                                   "covariance[5]", "covariance[6]", "covariance[7]",   "covariance[8]",
                                                   "odom_x_m",      "odom_y_m",      "odom_heading_rad"};

/// The numbers of a recorded pose in the order of the message.
std::array<double, kNumbers> numbers(const RecordedPose& pose) {
  const Pose2 &map = pose.T_map_body, &odom = pose.T_odom_body;
  std::array<double, kNumbers> out{map.x_m, map.y_m, map.heading_rad};
  std::ranges::copy(pose.covariance, out.begin() + 3);
  std::ranges::copy(std::array{odom.x_m, odom.y_m, odom.heading_rad}, out.begin() + 12);
  return out;
}

RecordedPose as_recorded(const EstimateRecord& estimate) {
  RecordedPose pose{.stamp = estimate.stamp,
                    .step = 0,
                    .T_map_body = estimate.T_map_body,
                    .covariance = {},
                    .T_odom_body = estimate.T_odom_body};
  for (std::size_t i = 0; i < pose.covariance.size(); ++i)
    pose.covariance[i] = estimate.covariance(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3));
  return pose;
}

/// Description of the first number that differs in any bit; empty if there is none.
std::string difference(const RecordedPose& recorded, const EstimateRecord& replayed) {
  const auto a = numbers(recorded), b = numbers(as_recorded(replayed));
  for (std::size_t i = 0; i < kNumbers; ++i) {
    if (std::bit_cast<std::uint64_t>(a[i]) == std::bit_cast<std::uint64_t>(b[i])) continue;
    return fmt::format("{} recorded as {:.17g}, replayed as {:.17g}", kNames[i], a[i], b[i]);
  }
  return {};
}

/// Compares the pose with the steps of the same stamp, of which there may be several, and returns an empty text if one
/// is identical.
std::string difference(const RecordedPose& recorded, const std::vector<EstimateRecord>& estimates) {
  const auto begin = std::ranges::lower_bound(estimates, recorded.stamp, {}, &EstimateRecord::stamp);
  std::string first = "no replayed step has its stamp";
  for (auto step = begin; step != estimates.end() && step->stamp == recorded.stamp; ++step) {
    std::string found = difference(recorded, *step);
    if (found.empty()) return found;
    if (step == begin) first = std::move(found);
  }
  return first;
}

}  // namespace

Verification verify(std::span<const RecordedPose> recorded, const ReplayResult& replayed) {
  Verification verification;
  verification.recorded = recorded.size();
  for (const RecordedPose& pose : recorded) {
    const std::string found = difference(pose, replayed.estimates);
    if (found.empty()) {
      ++verification.identical;
    } else if (verification.first_difference.empty()) {
      verification.first_difference =
          fmt::format("step {} at {:.6f} s: {}", pose.step, to_seconds(pose.stamp.time_since_epoch()), found);
    }
  }
  return verification;
}

std::string Verification::text() const {
  const std::string counted = fmt::format("{} of {} recorded poses identical", identical, recorded);
  return passed() ? counted : fmt::format("{}; first difference: {}", counted, first_difference);
}

}  // namespace azimuth
