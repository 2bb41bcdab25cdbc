#include "slam/estimator/sample_intake.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/estimator/sample_watch.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kOfOneThing_sigmas = 3.0;

bool is_of_one_thing(const Bearing& a, const Bearing& b, double sigma_bearing_rad) {
  const auto variance_rad2 = [&](const Bearing& bearing) {
    const double sigma_rad = std::isnan(bearing.sigma_rad) ? sigma_bearing_rad : bearing.sigma_rad;
    return sigma_rad * sigma_rad;
  };
  const double apart_rad = wrap(a.azimuth_rad - b.azimuth_rad);
  return apart_rad * apart_rad <= kOfOneThing_sigmas * kOfOneThing_sigmas * (variance_rad2(a) + variance_rad2(b));
}

/// Returns the number of bearings removed. Descriptors refer to bearings by index, so one bad bearing makes a set with
/// descriptors useless as a whole. So does an angle that can only be in degrees.
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

void SampleIntake::doubt_repeated_names(BearingSet& set, double sigma_bearing_rad) {
  by_name_.clear();
  for (std::size_t i = 0; i < set.bearings.size(); ++i)
    if (set.bearings[i].identity != kUnknownIdentity) by_name_.push_back(i);
  const auto name = [&set](std::size_t i) { return set.bearings[i].identity; };
  std::ranges::sort(by_name_,
                    [&](std::size_t a, std::size_t b) { return name(a) != name(b) ? name(a) < name(b) : a < b; });
  for (auto first = by_name_.begin(); first != by_name_.end();) {
    const auto end = std::find_if(first, by_name_.end(), [&](std::size_t i) { return name(i) != name(*first); });
    const bool agree = std::all_of(first, end, [&](std::size_t i) {
      return is_of_one_thing(set.bearings[*first], set.bearings[i], sigma_bearing_rad);
    });
    names_doubted_ += as_size(std::distance(agree ? first + 1 : first, end));
    for (auto i = agree ? first + 1 : first; i != end; ++i) set.bearings[*i].identity = kUnknownIdentity;
    first = end;
  }
}

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
