#pragma once
#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "slam/hypotheses/believed_pose.hpp"
#include "slam/hypotheses/hypothesis.hpp"
#include "slam/hypotheses/workers.hpp"

namespace azimuth {

struct BeamSettings {
  HypothesisSettings hypothesis;
  int members = 16;  ///< at the start
  /// The cost of an image grows with the map, so the number of members shrinks: members times landmarks of the best
  /// member is at most `most_landmarks`, but at least `fewest_members` stay.
  int most_landmarks = 480;
  int fewest_members = 4;
  int images_between_resampling = 12;  ///< 0: never; the number of members then stays constant
  int images_between_loops = 8;        ///< each member tries a loop closure once in so many images; 0: never
  double resampled_share = 1.0 / 3.0;  ///< share of the worst members, which become copies of the best
  double temperature = 30.0;           ///< a member's weight is exp(-energy / temperature)
};

/// Settings for a camera of this noise and field of view. Through a narrow view, energies do not rank maps: a map that
/// merges different landmarks is cheap, and the more members there are to choose from, the worse is the best one.
/// Members are therefore never resampled and have equal weights.
BeamSettings beam_settings_for(double sigma_bearing_rad, double field_of_view_rad);

/// A beam of different hypotheses. Its estimate is the mixture of all members (mathematics VI.20).
///
/// Thread contract: thread-bound; work is distributed by `workers`. The same calls give the same bits, regardless of
/// the workers.
class Beam {
 public:
  explicit Beam(const BeamSettings& settings);

  /// Starts all members from a saved map: see Hypothesis.
  void remember(const MapSnapshot& map, const Eigen::Matrix3d& moved);
  void begin(std::span<const NamelessSighting> sightings);
  void add_image(const Motion& motion, std::span<const NamelessSighting> sightings, Workers& workers,
                 double after_s = 1.0);

  /// Removes these images, ascending, from all members: see Hypothesis.
  void forget(std::span<const PoseId> images, Workers& workers);

  /// Corrects odometry and azimuths so far for these errors of the rig, in all members.
  void correct(const Calibration& errors, Workers& workers);

  /// The members, in no particular order.
  const std::vector<Hypothesis>& members() const { return members_; }
  const Hypothesis& best() const { return members_[best_]; }
  double best_energy() const { return energies_[best_]; }
  PoseId images() const { return best().images(); }

  using PoseBelief = BelievedPose;
  /// Mixture of the poses that `of_member` returns for each member, by the members' weights.
  PoseBelief mixture(const std::function<PoseBelief(const Hypothesis&)>& of_member) const;
  PoseBelief newest_pose() const { return newest_; }

  /// Difference in energy between the best member and the best of the members whose robot pose clearly differs from it;
  /// infinite when there is no such member. A small gap means that several maps explain the bearings.
  double gap() const { return gap_; }
  /// Total weight of the members whose robot pose clearly differs from that of the best member.
  double elsewhere() const { return elsewhere_; }

 private:
  bool looks_for_itself(std::size_t member) const;
  void resample();
  void narrow();
  std::vector<std::size_t> from_best_to_worst() const;
  void weigh();
  void conclude_image();
  void measure_gap();

  BeamSettings settings_;
  std::vector<Hypothesis> members_;
  std::vector<double> energies_, weights_;
  std::vector<Eigen::Matrix3d> newest_covariances_;
  std::size_t best_ = 0;
  PoseBelief newest_;
  double gap_, elsewhere_ = 0.0;
};

}  // namespace azimuth
