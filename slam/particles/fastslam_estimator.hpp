#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/image_troubles.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/estimator/lamp_directions.hpp"
#include "slam/estimator/map_fitness.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/fastslam/fastslam.hpp"
#include "slam/localisation/relocaliser.hpp"
#include "slam/particles/lamp_association.hpp"

namespace azimuth {

/// FastSLAM over lamps seen by a camera that looks up (SPEC part II). Bearings need an elevation; those without are not
/// used. Published are the pose and the map of the particle of the greatest weight.
///
/// A robot that begins from a map without knowing the pose is searched for: until it is found, what images show changes
/// nothing.
///
/// Thread contract: thread-bound.
class FastSlamEstimator final : public Estimator {
 public:
  /// A map to start from must be none of which why_unfit_for_fastslam() says anything.
  FastSlamEstimator(const Rig& rig, const FastSlamSettings& settings, const HealthSettings& health = {},
                    const MapStart& start = {}, const RelocalisationSettings& relocalisation = {});

  bool odometry_begins(bool goes_on) override;
  void predict(const Motion& motion) override;
  void update(const BearingSet& observations) override;
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override;
  bool save_map(MapSnapshot& out) const override;

  bool searching() const { return searching_; }
  const FastSlam& filter() const { return filter_; }

 private:
  // fastslam_saved_map.cpp
  void start_from(const MapStart& start);
  void begin_at(const StartPose& pose);
  void begin_search(const std::optional<Whereabouts>& within);
  CameraView camera_view() const;
  bool search();
  std::string_view why_lost() const;

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
  double inner_margin_;
  Relocaliser relocaliser_;
  std::optional<StartPose> undecided_;  ///< until the odometry has begun
  bool searching_ = false;              // for the pose
  AssociationCounts counts_;
  double path_m_ = 0.0, last_accepted_m_ = 0.0;
  ImageTroubles troubles_;
  std::size_t lights_ = 0;          // in the last image
  bool without_elevation_ = false;  // the last image had bearings, but none of use
  std::vector<LampSighting> sightings_;
  std::vector<SeenDirection> directions_seen_;  // the same, for a search
  std::vector<ExpectedBearing> expected_;       // of an image with more than can be used
};

}  // namespace azimuth
