#include "slam/estimator/sample_intake.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/estimator/sample_watch.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

/// How many. Looks go by index, so with one of them a set of looks is of no use altogether; nor is one in which an
/// angle can only be degrees.
std::size_t drop_not_usable(BearingSet& set) {
  const auto is_bad = [](const Bearing& bearing) { return !std::isfinite(bearing.azimuth_rad); };
  const auto bad = as_size(std::ranges::count_if(set.bearings, is_bad));
  const bool has_looks = !(set.descriptors.empty() && set.neighbours.empty());
  if ((bad > 0 && has_looks) || std::ranges::any_of(set.bearings, is_beyond_radians)) {
    const std::size_t all = set.bearings.size();
    set.clear();
    return all;
  }
  std::erase_if(set.bearings, is_bad);
  return bad;
}

}  // namespace

bool SampleIntake::takes(const OdometryReading& reading) {
  if (newest_reading_ && reading.sequence > *newest_reading_ + 1)
    counts_.odometry_gaps += reading.sequence - *newest_reading_ - 1;
  newest_reading_ = std::max(reading.sequence, newest_reading_.value_or(0));
  const Pose2& T = reading.T_odom_body;
  if (!std::isfinite(T.x_m) || !std::isfinite(T.y_m) || !std::isfinite(T.heading_rad)) {
    ++counts_.values_not_finite;
    return false;
  }
  const Stamp instant = clock_.instant_of(reading.stamp);
  const bool too_late = given_up_until_ && instant <= *given_up_until_;
  if (too_late || (last_reading_ && reading.stamp <= *last_reading_)) {
    ++counts_.odometry_out_of_order;
    return false;
  }
  last_reading_ = reading.stamp;
  return true;
}

bool SampleIntake::takes(const BearingSet& set) {
  if (newest_set_ && set.stamp < *newest_set_) {
    ++counts_.bearings_out_of_order;
    return false;
  }
  if (newest_set_ && set.sequence > newest_sequence_ + 1) counts_.bearing_gaps += set.sequence - newest_sequence_ - 1;
  newest_set_ = set.stamp;
  newest_sequence_ = set.sequence;
  return true;
}

void SampleIntake::keep_usable(BearingSet& set) { counts_.values_not_finite += drop_not_usable(set); }

WaitingSets::WaitingSets() : sets_(kMost) {
  for (BearingSet& set : sets_) set.bearings.reserve(kTypicalBearings);
}

void WaitingSets::add(BearingSet& set) {
  std::swap(sets_[(first_ + count_++) % kMost], set);
  set.clear();
}

void WaitingSets::drop_first() {
  sets_[first_].bearings.clear();
  first_ = (first_ + 1) % kMost;
  --count_;
}

}  // namespace azimuth
