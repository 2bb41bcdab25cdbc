// LampEkfEstimator: images with more directions than there is room for, as of a wet floor or the sun through leaves.

#include <algorithm>
#include <cmath>

#include "slam/estimator/lamp_ekf_estimator.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {

/// Of such an image only what may be of a confirmed lamp is used, the nearest first, and that there are so many makes
/// chance encounters likelier. The directions used stay in their order.
void LampEkfEstimator::thin_crowded() {
  const auto room = static_cast<std::size_t>(settings_.max_directions);
  lights_ = measured_.size();
  crowded_ = lights_ > room;
  new_density_per_sr_ = settings_.new_density_per_sr;
  if (!crowded_) return;
  const double in_view_sr = 2.0 * kPi * (1.0 - std::cos(max_zenith_rad_));
  new_density_per_sr_ = std::max(new_density_per_sr_, static_cast<double>(lights_) / in_view_sr);
  rank_by_confirmed();
  ranked_.resize(std::min(ranked_.size(), room));
  std::ranges::sort(ranked_, {}, &Ranked::direction);
  for (std::size_t k = 0; k < ranked_.size(); ++k) {
    const std::size_t from = ranked_[k].direction;  // never before k
    seen_[k] = seen_[from];
    measured_[k] = measured_[from];
    bearing_of_[k] = bearing_of_[from];
  }
  seen_.erase(seen_.begin() + static_cast<std::ptrdiff_t>(ranked_.size()), seen_.end());
  measured_.erase(measured_.begin() + static_cast<std::ptrdiff_t>(ranked_.size()), measured_.end());
  bearing_of_.resize(ranked_.size());
  counts_.rejected += lights_ - ranked_.size();
}

/// Those within the gate of a confirmed lamp, the nearest first.
void LampEkfEstimator::rank_by_confirmed() {
  ranked_.clear();
  for (std::size_t i = 0; i < measured_.size(); ++i) {
    double nearest2 = settings_.gate_chi2;
    for (const Predicted& predicted : predicted_)
      if (lamps_[predicted.lamp].confirmed) nearest2 = std::min(nearest2, squared_distance(measured_[i], predicted));
    if (nearest2 < settings_.gate_chi2) ranked_.push_back({nearest2, i});
  }
  std::ranges::sort(ranked_, [](const Ranked& a, const Ranked& b) {
    return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.direction < b.direction;
  });
}

}  // namespace azimuth
