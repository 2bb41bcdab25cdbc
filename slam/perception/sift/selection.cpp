#include "slam/perception/sift/selection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

float between_rad(float a_rad, float b_rad) {
  const float apart_rad = std::abs(a_rad - b_rad);
  return std::min(apart_rad, 2.0F * std::numbers::pi_v<float> - apart_rad);
}

/// Uses doubles: the last bits of atan2 for floats differ between arm64 and x86.
float angle_rad(float x, float y) {
  return static_cast<float>(std::atan2(static_cast<double>(y), static_cast<double>(x)));
}

}  // namespace

FeatureSelection::FeatureSelection(const SiftSettings& settings, double centre_px)
    : target_count_(as_size(std::max(0, settings.target_count))),
      share_(std::max<std::size_t>(1, target_count_ / as_size(std::max(1, settings.sectors)))),
      half_sector_rad_(std::numbers::pi_v<float> / static_cast<float>(std::max(1, settings.sectors))),
      centre_px_(static_cast<float>(centre_px)) {}

void FeatureSelection::order(const std::vector<KeyPoint>& key_points) {
  candidates_.clear();
  for (const KeyPoint& point : key_points)
    candidates_.push_back({point, angle_rad(point.x_px - centre_px_, point.y_px - centre_px_)});
  std::ranges::sort(candidates_, stronger, &Candidate::point);
}

bool FeatureSelection::has_room(const Candidate& candidate) const {
  std::size_t chosen_near = 0;
  for (const Candidate& other : chosen_) {
    if (between_rad(candidate.azimuth_rad, other.azimuth_rad) <= half_sector_rad_) ++chosen_near;
    if (chosen_near == share_) return false;
  }
  return true;
}

void FeatureSelection::select(std::vector<KeyPoint>& key_points) {
  order(key_points);
  chosen_.clear();
  left_over_.clear();
  for (const Candidate& candidate : candidates_) {
    if (target_count_ == 0 || has_room(candidate)) {
      chosen_.push_back(candidate);
    } else {
      left_over_.push_back(candidate);
    }
    if (chosen_.size() == target_count_ && target_count_ > 0) break;
  }
  for (const Candidate& candidate : left_over_) {
    if (chosen_.size() == target_count_) break;
    chosen_.push_back(candidate);
  }
  std::ranges::sort(chosen_, stronger, &Candidate::point);
  key_points.clear();
  for (const Candidate& candidate : chosen_) key_points.push_back(candidate.point);
}

}  // namespace azimuth
