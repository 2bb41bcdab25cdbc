#include "slam/hindsight/rest_watch.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

// What an odometer may say of a robot that stands still, and the distance of something near.
constexpr double kRest_m = 0.02, kRest_rad = 0.02, kNearby_m = 0.4;
// Images of the motion may come after odometry has said that it is over.
constexpr Duration kSettles = std::chrono::seconds(1);
constexpr double kGate_sigmas = 3.0;
constexpr int kFewestCommon = 3;  // landmarks: fewer may have been moved themselves
// What a robot is carried away from in a straight line hardly moves.
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

void RestWatch::add(const BearingSet& image, double sigma_rad, double noise) {
  if (!rests_since_ || driven_m_ > kRest_m || turned_rad_ > kRest_rad) {
    rests_since_ = image.stamp;
    reference_.reset();
    driven_m_ = turned_rad_ = 0.0;
    carried_ = false;
  }
  if (!reference_) {
    if (image.stamp - *rests_since_ >= kSettles) reference_ = image;
    return;
  }
  const double by_rest_rad = turned_rad_ + driven_m_ / kNearby_m;
  int common = 0, moved = 0;
  for (const Bearing& bearing : image.bearings) {
    if (bearing.identity == kUnknownIdentity) continue;
    const auto before = std::ranges::find(reference_->bearings, bearing.identity, &Bearing::identity);
    if (before == reference_->bearings.end()) continue;
    const double sigma = noise * std::sqrt(variance(*before, sigma_rad) + variance(bearing, sigma_rad));
    ++common;
    moved += std::abs(wrap(bearing.azimuth_rad - before->azimuth_rad)) > kGate_sigmas * sigma + by_rest_rad ? 1 : 0;
  }
  if (common < kFewestCommon) return;
  if (2 * moved > common) {
    carried_ = true;
    reference_ = image;
  } else if (image.stamp - reference_->stamp >= kStandsStill) {
    carried_ = false;
  }
}

}  // namespace azimuth
