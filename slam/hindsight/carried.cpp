#include "slam/hindsight/carried.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "slam/geometry/angle.hpp"
#include "slam/lost/lost_robot.hpp"

namespace azimuth {
namespace {

// Motion that odometry may report for a robot at rest, and the assumed distance of a near landmark.
constexpr double kRest_m = 0.02, kRest_rad = 0.02, kNearby_m = 0.4;
// Delay after which images count as taken at rest; images taken during a motion may arrive after odometry reports the
// end of the motion.
constexpr Duration kSettles = std::chrono::seconds(1);
constexpr double kGate_sigmas = 3.0;
// Least number of landmarks seen before and now; fewer landmarks may have been moved themselves, without the robot.
constexpr int kFewestCommon = 3;
// Without identities, clutter counts as well. Landmarks that one image missed appear in the next ones.
constexpr int kFewestUnnamed = 5, kReferenceImages = 2;
// Time without change after which the robot counts as put down. A landmark right behind or ahead hardly moves while the
// robot is carried.
constexpr Duration kStandsStill = std::chrono::seconds(3);

double variance(const Bearing& bearing, double sigma_rad) {
  const double sigma = std::isnan(bearing.sigma_rad) ? sigma_rad : bearing.sigma_rad;
  return sigma * sigma;
}

}  // namespace

void RestWatch::predict(const Motion& motion) {
  driven_m_ += motion.path_m;
  turned_rad_ += std::abs(motion.T_start_end.heading_rad);
}

/// Whether the robot has been at rest for long enough that its images are at rest too.
bool RestWatch::is_at_rest(Stamp stamp) {
  if (!rests_since_ || driven_m_ > kRest_m || turned_rad_ > kRest_rad) {
    rests_since_ = stamp;
    reference_.clear();
    images_ = 0;
    driven_m_ = turned_rad_ = 0.0;
    carried_ = false;
  }
  return stamp - *rests_since_ >= kSettles;
}

const Bearing* RestWatch::seen_before(const Bearing& bearing) const {
  const Bearing* nearest = nullptr;
  for (const Bearing& before : reference_) {
    if (named_ && before.identity != bearing.identity) continue;
    const auto off_rad = [&](const Bearing& other) { return std::abs(wrap(bearing.azimuth_rad - other.azimuth_rad)); };
    if (nearest == nullptr || off_rad(before) < off_rad(*nearest)) nearest = &before;
  }
  return nearest;
}

void RestWatch::add(const BearingSet& image, double sigma_rad, double noise) {
  if (!is_at_rest(image.stamp)) return;
  const double by_rest_rad = turned_rad_ + driven_m_ / kNearby_m;
  std::vector<Bearing> seen;
  int common = 0, moved = 0;
  for (const Bearing& bearing : image.bearings) {
    if (named_ && bearing.identity == kUnknownIdentity) continue;
    seen.push_back(bearing);
    const Bearing* const before = seen_before(bearing);
    if (before == nullptr) continue;
    const double sigma = noise * std::sqrt(variance(*before, sigma_rad) + variance(bearing, sigma_rad));
    ++common;
    moved += std::abs(wrap(bearing.azimuth_rad - before->azimuth_rad)) > kGate_sigmas * sigma + by_rest_rad ? 1 : 0;
  }
  const bool has_moved = common >= (named_ ? kFewestCommon : kFewestUnnamed) && 2 * moved > common;
  if (has_moved) {
    carried_ = true;
    images_ = 0;
  } else if (images_ >= (named_ || carried_ ? 1 : kReferenceImages)) {
    if (common >= kFewestCommon && image.stamp - seen_ >= kStandsStill) carried_ = false;
    return;
  }
  if (images_ == 0) reference_.clear();
  reference_.insert(reference_.end(), seen.begin(), seen.end());
  ++images_;
  seen_ = image.stamp;
}

void NamesSeen::add(const BearingSet& image, double path_m) {
  Image& kept = images_[next_++ % kImages];
  kept.path_m = path_m;
  kept.names.clear();
  for (const Bearing& bearing : image.bearings)
    if (bearing.identity != kUnknownIdentity) kept.names.push_back(bearing.identity);
  passed_over_ = 0;
}

bool NamesSeen::is_due(Identity name, double path_m) const {
  if (passed_over_ >= kImages) return false;
  return std::ranges::any_of(images_, [&](const Image& image) {
    return path_m - image.path_m < kMoment_m && std::ranges::find(image.names, name) != image.names.end();
  });
}

}  // namespace azimuth
