#include "slam/hindsight/landmark_covariances.hpp"

namespace azimuth {

void LandmarkCovariances::refresh(std::span<const HindsightLandmark> landmarks, const Smoother& smoother) {
  if (landmarks.size() <= kEachTime) return forget();
  for (std::size_t i = 0; i < kEachTime; ++i, ++next_) {
    if (next_ >= landmarks.size()) next_ = 0;
    const HindsightLandmark& landmark = landmarks[next_];
    kept_[landmark.id] = {landmark.in_graph, smoother.point_covariance(landmark.in_graph)};
  }
}

Eigen::Matrix2d LandmarkCovariances::of(const HindsightLandmark& landmark, const Smoother& smoother) const {
  const auto kept = kept_.find(landmark.id);
  const bool is_it = kept != kept_.end() && kept->second.in_graph == landmark.in_graph;
  return is_it ? kept->second.covariance_m2 : smoother.point_covariance(landmark.in_graph);
}

}  // namespace azimuth
