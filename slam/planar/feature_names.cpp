#include "slam/planar/feature_names.hpp"

#include <algorithm>
#include <functional>

namespace azimuth {

const BearingSet& FeatureNames::name(const BearingSet& image, std::span<const PlanarLandmark> landmarks,
                                     const Candidates& candidates, const PlanarView& view, bool pose_is_a_guess) {
  write_sighted(view.ekf(), candidates, beliefs_);
  beliefs_.anywhere = pose_is_a_guess;
  beliefs_.mapped.clear();
  for (const PlanarLandmark& landmark : landmarks) {
    IdentityBeliefs::Mapped& mapped = beliefs_.mapped.emplace_back();
    mapped.identity = landmark.identity;
    if (const auto predicted = view.predict_straight(landmark)) {
      mapped.azimuth_rad = predicted->azimuth_rad;
      mapped.variance_rad2 = predicted->variance_rad2;
    }
  }
  std::ranges::sort(beliefs_.mapped, std::less{}, &IdentityBeliefs::Mapped::identity);
  return identities_.name(image, beliefs_);
}

}  // namespace azimuth
