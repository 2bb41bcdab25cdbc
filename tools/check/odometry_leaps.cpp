#include "tools/check/odometry_leaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kLeastReadings = 20;
constexpr double kMoves_m = 1e-3;   // a step shorter than this counts as standing
constexpr double kPaceShare = 0.8;  // quantile of the speeds of all moving steps
constexpr double kTimesPace = 5.0;
constexpr double kLeast_m = 0.03;       // encoder steps and stamp jitter cause steps shorter than this
constexpr double kGrip_m_s2 = 10.0;     // no wheeled robot accelerates faster than this: tyres slip
constexpr double kGoneOn = 0.7;         // a neighbour that differs by less than this fraction of a step continues it
constexpr std::size_t kMostApart = 12;  // most readings between alternations of two senders
constexpr double kUndone = 0.4;         // a leap is undone if at most this fraction of it remains after a later leap
constexpr double kAtOrigin_m = 0.05;
constexpr std::size_t kLeastTurns = 5;
constexpr double kMostlyUndone = 0.6;

struct Step {
  Eigen::Vector2d by_m = Eigen::Vector2d::Zero();
  double took_s = 0.0;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

/// Typical speed of the moving robot, from pairs of readings that are `apart` indices apart.
double pace_m_s(std::span<const OdometryReading> odometry, std::size_t apart) {
  std::vector<double> speeds;
  for (std::size_t i = apart; i < odometry.size(); ++i) {
    const double way_m = (odometry[i].T_odom_body.position() - odometry[i - apart].T_odom_body.position()).norm();
    const double took_s = to_seconds(odometry[i].stamp - odometry[i - apart].stamp);
    if (way_m > kMoves_m && took_s > 0.0) speeds.push_back(way_m / took_s);
  }
  return quantile(std::move(speeds), kPaceShare);
}

/// The least typical speed over all index distances. Readings of two alternating senders suggest a high speed between
/// neighbours, but the true speed between readings of the same sender.
double pace_m_s(std::span<const OdometryReading> odometry) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t apart = 1; apart <= kMostApart && apart < odometry.size(); ++apart)
    least = std::min(least, pace_m_s(odometry, apart));
  return least;
}

std::vector<Step> steps_of(std::span<const OdometryReading> odometry) {
  std::vector<Step> steps(odometry.size());
  for (std::size_t i = 1; i < odometry.size(); ++i)
    if (odometry[i].origin == odometry[i - 1].origin)
      steps[i] = {odometry[i].T_odom_body.position() - odometry[i - 1].T_odom_body.position(),
                  to_seconds(odometry[i].stamp - odometry[i - 1].stamp)};
  return steps;
}

bool goes_on(const Step& step, const Step& neighbour) {
  return (step.by_m - neighbour.by_m).norm() < kGoneOn * step.by_m.norm();
}

}  // namespace

bool OdometryLeaps::are_two_senders() const {
  return undone >= kLeastTurns && static_cast<double>(undone) >= kMostlyUndone * static_cast<double>(leaps);
}

OdometryLeaps odometry_leaps(std::span<const OdometryReading> odometry) {
  OdometryLeaps found{.readings = odometry.size()};
  if (odometry.size() < kLeastReadings) return found;
  const std::vector<Step> steps = steps_of(odometry);
  std::vector<double> intervals_s;
  for (const Step& step : steps)
    if (step.took_s > 0.0) intervals_s.push_back(step.took_s);
  const double interval_s = quantile(std::move(intervals_s), 0.5), pace = pace_m_s(odometry);
  std::vector<char> is_leap(steps.size());
  std::vector<double> lengths;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const double length_m = steps[i].by_m.norm();
    const double took_s = std::max(steps[i].took_s, interval_s);
    if (length_m < kLeast_m || length_m < kTimesPace * pace * took_s || length_m < kGrip_m_s2 * took_s * took_s)
      continue;
    if (goes_on(steps[i], steps[i - 1]) || (i + 1 < steps.size() && goes_on(steps[i], steps[i + 1]))) continue;
    is_leap[i] = 1;
    lengths.push_back(length_m);
    if (found.leaps++ == 0) found.first = odometry[i].stamp;
    const Eigen::Vector2d there = odometry[i].T_odom_body.position();
    if (std::min(there.norm(), (there - odometry.front().T_odom_body.position()).norm()) < kAtOrigin_m)
      ++found.to_origin;
  }
  for (std::size_t i = 0; i < steps.size(); ++i)
    for (std::size_t j = i + 1; is_leap[i] != 0 && j < std::min(steps.size(), i + 1 + kMostApart); ++j) {
      if (is_leap[j] == 0 || (steps[i].by_m + steps[j].by_m).norm() > kUndone * steps[i].by_m.norm()) continue;
      ++found.undone;
      break;
    }
  found.typical_m = quantile(std::move(lengths), 0.5);
  return found;
}

}  // namespace azimuth
