#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "slam/association/assignment.hpp"
#include "slam/association/direction_hypothesis.hpp"
#include "slam/association/joint_compatibility.hpp"

namespace azimuth {

struct MeasuredDirection {
  TangentDirection seen;
  Identity identity = kUnknownIdentity;
};

struct DirectionGates {
  double individual_chi2 = 13.8;    ///< of one pairing, 2 degrees of freedom
  double joint_probability = 0.99;  ///< confidence of the joint test
  double new_density_per_sr = 0.1;  ///< directions of something unmapped, per steradian and image
  /// A joint hypothesis this near in log-likelihood to the best one is its rival, and what the two explain differently
  /// is ambiguous. 0: the best one is always believed.
  double rival_log_ratio = 2.0;
  int max_hypotheses = 32;  ///< tried, beside the first
  /// Multiplications after which no further hypothesis is tried; 5 * 10^7 take some tens of milliseconds.
  std::uint64_t max_operations = 50'000'000;
};

/// What a direction is of.
enum class DirectionFate : std::uint8_t {
  fresh,      ///< nothing predicted can be meant
  paired,     ///< a landmark
  ambiguous,  ///< two hypotheses explain it otherwise, about equally well
  refused     ///< something predicted could be meant, but another direction is of that, or the joint test says no
};
struct DirectionMatch {
  DirectionFate fate = DirectionFate::fresh;
  int landmark = kNoLandmark;  ///< when paired
};

/// Which direction is of which landmark: the best assignment (Hungarian) by the marginal likelihoods, tested jointly,
/// since an error of the pose moves all predictions together. Where pairings are disputed, further hypotheses start
/// from one disputed pairing each: the others are then assigned by what is left to them once that one is believed. The
/// hypothesis of the largest joint likelihood wins.
///
/// Thread contract: thread-bound; does not allocate once its workspace has grown to the largest image.
class DirectionMatching {
 public:
  /// One match per measurement in `out`.
  void match(std::span<const MeasuredDirection> measured, const PredictedOffsets& predicted,
             const DirectionGates& gates, std::vector<DirectionMatch>& out);

 private:
  struct Try {
    double log_likelihood;
    std::size_t first;  // of its choices
  };
  void find_pairs();
  bool is_disputed(const DirectionPair& pair) const;
  void try_from(const DirectionPair* seed);
  bool assign_the_rest();
  void believe_in_order();
  void take(const DirectionPair& pair);
  void keep();
  void choose(std::vector<DirectionMatch>& out);
  void mark_rivals(const Try& best, std::vector<DirectionMatch>& out) const;
  void refuse_incompatible(std::vector<DirectionMatch>& out);
  void refuse_explained(std::vector<DirectionMatch>& out);

  std::span<const MeasuredDirection> measured_;
  const PredictedOffsets* predicted_ = nullptr;
  DirectionGates gates_;
  std::vector<DirectionPair> pairs_;  // within their gate
  std::vector<int> pairs_of_seen_, pairs_of_landmark_;
  Assignment assignment_;
  DirectionHypothesis hypothesis_;
  std::vector<int> landmark_of_;     // of each direction, in the hypothesis being made
  std::vector<std::uint8_t> taken_;  // landmarks
  std::vector<double> table_, alone_;
  std::vector<int> column_of_row_;
  std::vector<DirectionPair> assigned_;
  std::vector<Try> tries_;
  std::vector<int> choices_;  // of all tries
  JointTest joint_test_;
  Workspace S_;
  std::vector<double> innovations_;
  std::vector<std::uint8_t> accepted_;
};

}  // namespace azimuth
