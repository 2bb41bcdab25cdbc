#pragma once
#include <span>

#include "slam/estimator/rig.hpp"
#include "slam/planar/candidates.hpp"
#include "slam/planar/ekf_settings.hpp"
#include "slam/planar/feature_identities.hpp"
#include "slam/planar/planar_view.hpp"

namespace azimuth {

/// Assigns identities to features by descriptors and by the planar filter's belief of where landmarks are.
///
/// Thread contract: thread-bound.
class FeatureNames {
 public:
  FeatureNames(const Rig& rig, const EkfSettings& settings)
      : identities_(settings.identity, rig.camera.sigma_bearing_rad, settings.max_viewing_distance_m) {}

  /// The image with an identity for each bearing; see FeatureIdentities::name(). While the pose is a guess only
  /// descriptors decide.
  const BearingSet& name(const BearingSet& image, std::span<const PlanarLandmark> landmarks,
                         const Candidates& candidates, const PlanarView& view, bool pose_is_a_guess);

  const FeatureIdentities& identities() const { return identities_; }
  FeatureIdentities& identities() { return identities_; }

 private:
  FeatureIdentities identities_;
  IdentityBeliefs beliefs_;
};

}  // namespace azimuth
