#pragma once
#include <string_view>
#include <vector>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/image_troubles.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/estimator/lamp_association.hpp"
#include "slam/estimator/lamp_directions.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/fastslam/fastslam.hpp"

namespace azimuth {

/// FastSLAM over lamps seen by a camera that looks up (SPEC part II). Bearings need an elevation; those without are not
/// used. Published are the pose and the map of the particle of the greatest weight.
///
/// Thread contract: thread-bound.
class FastSlamEstimator final : public Estimator {
 public:
  FastSlamEstimator(const Rig& rig, const FastSlamSettings& settings, const HealthSettings& health = {});

  void predict(const Motion& motion) override;
  void update(const BearingSet& observations) override;
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override;

  const FastSlam& filter() const { return filter_; }

 private:
  void choose(const std::vector<Bearing>& bearings);
  void use(const Bearing& bearing);
  Symmetric2 noise_of(const Bearing& bearing) const;
  PoseBelief belief() const;
  void write(const PoseBelief& belief, double path_m, Estimate& out) const;
  std::string_view why_starting(const Judgement& judgement) const;
  Judgement judged(const Eigen::Matrix3d& covariance, double path_m) const;

  Rig rig_;
  LampDirections directions_;
  HealthSettings judged_by_;
  std::size_t max_landmarks_;
  double gate_sigmas_, sigma_floor_rad_;
  FastSlam filter_;
  LampAssociation association_;
  AssociationCounts counts_;
  double path_m_ = 0.0, last_accepted_m_ = 0.0;
  ImageTroubles troubles_;
  std::size_t lights_ = 0;          // in the last image
  bool without_elevation_ = false;  // the last image had bearings, but none of use
  std::vector<LampSighting> sightings_;
  std::vector<ExpectedBearing> expected_;  // of an image with more than can be used
};

}  // namespace azimuth
