#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/health_settings.hpp"
#include "slam/estimator/judgement.hpp"
#include "slam/estimator/lamp_directions.hpp"
#include "slam/estimator/map_start.hpp"
#include "slam/estimator/pose_belief.hpp"
#include "slam/estimator/recognition_history.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/estimator/start_from_map.hpp"
#include "slam/fastslam/fastslam.hpp"
#include "slam/localisation/relocaliser.hpp"
#include "slam/particles/lamp_association.hpp"

namespace azimuth {

/// FastSLAM with lamps seen by a camera that looks up (mathematics part II). Bearings without an elevation are ignored.
/// The published pose and map are those of the particle with the greatest weight.
///
/// A robot that starts from a map with an unknown pose is relocalised first; until then, images change neither pose nor
/// map.
///
/// Thread contract: thread-bound.
class FastSlamEstimator final : public Estimator {
 public:
  /// A map to start from must be fit: why_unfit_for_fastslam() must be empty for it.
  FastSlamEstimator(const Rig& rig, const FastSlamSettings& settings, const MapStart& start = {},
                    const HealthSettings& health = {}, const RelocalisationSettings& relocalisation = {});

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
  void start_from(const MapStart& start);
  void begin_at(const StartPose& pose);
  void begin_search(const std::optional<PositionPrior>& within);
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
  std::optional<StartPose> undecided_;  ///< start pose, pending until odometry starts
  bool searching_ = false;              // whether relocalisation is running
  AssociationCounts counts_;
  double path_m_ = 0.0, last_accepted_m_ = 0.0;
  ImageTroubles troubles_;
  std::size_t lights_ = 0;          // number of bearings in the last image
  bool without_elevation_ = false;  // the last image had bearings, but none with an elevation
  std::vector<LampSighting> sightings_;
  std::vector<SeenDirection> directions_seen_;  // the same detections, for relocalisation
  std::vector<ExpectedBearing> expected_;       // used only when an image has too many bearings
};

}  // namespace azimuth
