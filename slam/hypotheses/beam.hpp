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
  int members = 16;  ///< to begin with
  /// The work of an image grows with the map, so the beam narrows: members times the landmarks of the best one are at
  /// most this, but there are never fewer than the fewest.
  int most_landmarks = 480;
  int fewest_members = 4;
  int images_between_resampling = 12;  ///< 0: never, and the beam stays as wide as it is
  int images_between_loops = 8;        ///< in which a member looks for itself in its own map, by turns; 0: never
  double resampled_share = 1.0 / 3.0;  ///< the worst, which become copies of the best
  double temperature = 30.0;           ///< a member's weight is exp(-energy / temperature)
};

/// For a camera of this noise and view. Through a narrow view energies do not rank maps: those that make two landmarks
/// of different things one are cheap, and the more members are chosen from, the worse is the best one. So all go on by
/// themselves, and count the same.
BeamSettings beam_settings_for(double sigma_bearing_rad, double field_of_view_rad);

/// Hypotheses that differ, side by side. What is said is the mixture of all of them (SPEC VI.20).
///
/// Thread contract: thread-bound; work is spread as `workers` do. Same calls, same bits, whatever the workers.
class Beam {
 public:
  explicit Beam(const BeamSettings& settings);

  /// All members begin from a saved map: see Hypothesis.
  void remember(const MapSnapshot& map, const Eigen::Matrix3d& moved);
  void begin(std::span<const NamelessSighting> sightings);
  void add_image(const Motion& motion, std::span<const NamelessSighting> sightings, Workers& workers,
                 double after_s = 1.0);

  /// All members forget these images, ascending: see Hypothesis.
  void forget(std::span<const PoseId> images, Workers& workers);

  /// In no order.
  const std::vector<Hypothesis>& members() const { return members_; }
  const Hypothesis& best() const { return members_[best_]; }
  double best_energy() const { return energies_[best_]; }
  PoseId images() const { return best().images(); }

  using PoseBelief = BelievedPose;
  /// Of all members together, where each says where it has the robot.
  PoseBelief mixture(const std::function<PoseBelief(const Hypothesis&)>& of_member) const;
  PoseBelief newest_pose() const { return newest_; }

  /// By how much the best member's energy is below that of the best one that has the robot somewhere else; infinite
  /// when none has. Little: several maps explain what was seen.
  double gap() const { return gap_; }
  /// The weight of all those.
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
