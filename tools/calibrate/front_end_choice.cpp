#include "tools/calibrate/front_end_choice.hpp"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <optional>

#include "slam/association/descriptor_block.hpp"

namespace azimuth {
namespace {

constexpr int kFixAPose = 3;  // three bearings of known landmarks determine a pose in the plane
// Ratio test: largest squared ratio of the nearest descriptor distance to the second nearest.
constexpr double kMostAlike = 0.7 * 0.7;

/// Number of coloured landmarks that both images may show. Landmarks of one colour cannot be told apart, so each colour
/// counts with the smaller of its two numbers.
int coloured_again(const BearingSet& earlier, const BearingSet& later) {
  std::map<Kind, int> left;
  for (const Bearing& bearing : earlier.bearings) ++left[bearing.kind];
  int again = 0;
  for (const Bearing& bearing : later.bearings)
    if (left[bearing.kind]-- > 0) ++again;
  return again;
}

std::int32_t squared_distance(const Descriptor& a, const Descriptor& b) {
  return dot_product(a, a) - 2 * dot_product(a, b) + dot_product(b, b);
}

/// Index of the descriptor in `others` that matches `looks` and passes the ratio test; nothing if none does.
std::optional<std::size_t> alike(const Descriptor& looks, const std::vector<Descriptor>& others) {
  std::int32_t least = std::numeric_limits<std::int32_t>::max(), next = least;
  std::size_t best = 0;
  for (std::size_t i = 0; i < others.size(); ++i) {
    const std::int32_t apart = squared_distance(looks, others[i]);
    next = std::min(next, std::max(apart, least));
    if (apart < least) best = i;
    least = std::min(least, apart);
  }
  const bool clearly = static_cast<double>(least) < kMostAlike * static_cast<double>(next);
  return clearly ? std::optional(best) : std::nullopt;
}

int features_again(const BearingSet& earlier, const BearingSet& later) {
  int again = 0;
  for (std::size_t i = 0; i < earlier.descriptors.size(); ++i) {
    const auto there = alike(earlier.descriptors[i], later.descriptors);
    if (there && alike(later.descriptors[*there], earlier.descriptors) == i) ++again;
  }
  return again;
}

int median(std::vector<int> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::ptrdiff_t with_a_pose(const FrontEndsSeenAgain& seen) {
  return std::ranges::count_if(seen.coloured, [](int again) { return again >= kFixAPose; });
}

}  // namespace

FrontEnd front_end_for(const FrontEndsSeenAgain& seen) {
  const bool most = 2 * with_a_pose(seen) > std::ssize(seen.coloured);
  return most ? FrontEnd::colour : FrontEnd::sift;
}

bool is_doubtful(const FrontEndsSeenAgain& seen) {
  return !seen.coloured.empty() && front_end_for(seen) == FrontEnd::sift && median(seen.features_again) < kFixAPose;
}

std::string reason(const FrontEndsSeenAgain& seen) {
  if (seen.coloured.empty()) return "a single image does not say what is seen again";
  return fmt::format(
      "{} or more coloured landmarks are seen in {} of {} images and again in the next; of {} features {} are",
      kFixAPose, with_a_pose(seen), seen.coloured.size(), median(seen.features), median(seen.features_again));
}

FrontEndTrial::FrontEndTrial(const CameraRig& rig) : colour_(rig, {}), sift_(rig, {}) {}

void FrontEndTrial::add(const ImageView& earlier, const ImageView& later) {
  const auto look = [&](Perception& front_end) {
    front_end.observe(earlier, sets_[0]);
    front_end.observe(later, sets_[1]);
  };
  look(colour_);
  seen_.coloured.push_back(coloured_again(sets_[0], sets_[1]));
  look(sift_);
  seen_.features.push_back(static_cast<int>(sets_[0].bearings.size()));
  seen_.features_again.push_back(features_again(sets_[0], sets_[1]));
}

}  // namespace azimuth
