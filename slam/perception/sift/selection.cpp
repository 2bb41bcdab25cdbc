#include "slam/perception/sift/selection.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {

FeatureSelection::FeatureSelection(const SiftSettings& settings, double centre_px)
    : target_count_(settings.target_count),
      sectors_(static_cast<std::size_t>(std::max(1, settings.sectors))),
      centre_px_(static_cast<float>(centre_px)) {}

std::size_t FeatureSelection::sector(const KeyPoint& point) const {
  constexpr float kTurn = 6.28318531F;
  const float angle = std::atan2(point.y_px - centre_px_, point.x_px - centre_px_) / kTurn + 0.5F;
  return std::min(static_cast<std::size_t>(angle * static_cast<float>(sectors_)), sectors_ - 1);
}

void FeatureSelection::select(std::vector<KeyPoint>& key_points) {
  std::ranges::sort(key_points, stronger);
  if (target_count_ <= 0 || key_points.size() <= static_cast<std::size_t>(target_count_)) return;
  const int share = target_count_ / static_cast<int>(sectors_);
  chosen_in_.assign(sectors_, 0);
  chosen_.clear();
  left_over_.clear();
  for (const KeyPoint& point : key_points) {
    int& chosen = chosen_in_[sector(point)];
    (chosen < share ? chosen_ : left_over_).push_back(point);
    ++chosen;
  }
  const std::size_t room = static_cast<std::size_t>(target_count_) - chosen_.size();
  chosen_.insert(chosen_.end(), left_over_.begin(),
                 left_over_.begin() + static_cast<std::ptrdiff_t>(std::min(room, left_over_.size())));
  std::ranges::sort(chosen_, stronger);
  key_points.swap(chosen_);
}

}  // namespace azimuth
