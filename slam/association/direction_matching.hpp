#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/association/assignment.hpp"
#include "slam/association/joint_compatibility.hpp"
#include "slam/geometry/index.hpp"
#include "slam/geometry/tangent_direction.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

// A joint hypothesis over directions and predictions: accepted pairs, and what they imply for other pairs.

/// Predicted landmarks, by their horizontal offset per metre of height, m, in the robot's frame.
struct PredictedOffsets {
  std::span<const Eigen::Vector2d> m;
  Eigen::Ref<const Eigen::MatrixXd> covariance;  ///< Joint, in blocks of 2 x 2
  std::span<const Identity> identity = {};       ///< Name of each landmark; empty: no landmark has a name
};

/// A direction paired with a predicted landmark. Innovation and S are in the plane tangent to the unit sphere at the
/// direction.
struct DirectionPair {
  int seen = 0;
  int landmark = 0;
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
  Eigen::Matrix2d by_offset = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d S = Eigen::Matrix2d::Zero();  ///< Covariance of the innovation
  double distance2 = 0.0;                       ///< innovation^T S^-1 innovation
  double log_likelihood = 0.0;                  ///< ln N(innovation; 0, S)

  /// Computes distance2 and log_likelihood from innovation and S.
  void judge();
};

/// Accepted pairs, in the order in which they were added, with the Cholesky factor of their joint innovation
/// covariance.
///
/// Thread contract: thread-bound; does not allocate once its workspace has grown to the largest image.
class DirectionHypothesis {
 public:
  /// Starts without pairs, with room for `most`. `predicted` must outlive the use of the hypothesis.
  void start(const PredictedOffsets& predicted, std::size_t most);

  /// The pair conditioned on the accepted pairs.
  DirectionPair given(const DirectionPair& pair);
  /// Accepts a pair. Returns false, without accepting it, if its conditional covariance is singular.
  bool believe(const DirectionPair& pair);

  std::span<const DirectionPair> believed() const { return believed_; }
  double log_likelihood() const { return log_likelihood_; }
  double distance2() const { return distance2_; }

  /// Estimated number of multiplications since forget_operations().
  std::uint64_t operations() const { return operations_; }
  void forget_operations() { operations_ = 0; }

 private:
  Eigen::Index rows() const { return 2 * as_index(believed_.size()); }
  void whiten_against_believed(const DirectionPair& pair);

  const PredictedOffsets* predicted_ = nullptr;
  std::vector<DirectionPair> believed_;
  Eigen::MatrixXd L_;         // S = L L^T
  Eigen::MatrixXd across_;    // L^-1 times the covariance with the pair under test, two columns
  Eigen::VectorXd whitened_;  // L^-1 innovation
  double log_likelihood_ = 0.0, distance2_ = 0.0;
  std::uint64_t operations_ = 0;
};

struct MeasuredDirection {
  TangentDirection seen;
  Identity identity = kUnknownIdentity;
};

struct DirectionGates {
  double individual_chi2 = 13.8;    ///< Gate of one pair, 2 degrees of freedom
  double joint_probability = 0.99;  ///< Confidence of the joint test
  double new_density_per_sr = 0.1;  ///< Expected directions of unmapped landmarks and clutter, per steradian and image
  /// A joint hypothesis within this log-likelihood of the best one is its rival; directions that the two explain
  /// differently are ambiguous. 0: the best hypothesis is always used.
  double rival_log_ratio = 2.0;
  int max_hypotheses = 32;  ///< Number of hypotheses tried besides the first
  /// Multiplications after which no further hypothesis is tried; 5 * 10^7 take some tens of milliseconds.
  std::uint64_t max_operations = 50'000'000;
};

/// Outcome of the association of a direction.
enum class DirectionFate : std::uint8_t {
  fresh,      ///< No predicted landmark is within the gate
  paired,     ///< Paired with a landmark
  ambiguous,  ///< Two hypotheses explain the direction differently and about equally well
  refused     ///< A predicted landmark is within the gate, but another direction takes it, or the joint test fails
};
struct DirectionMatch {
  DirectionFate fate = DirectionFate::fresh;
  int landmark = kNoLandmark;  ///< The landmark, if `fate` is paired
};

/// Data association of directions with landmarks: the best assignment (Hungarian) by the marginal likelihoods, tested
/// jointly, since an error of the pose moves all predictions together. Where pairs are disputed, each further
/// hypothesis starts from one disputed pair and assigns the other directions conditioned on it. The hypothesis with the
/// largest joint likelihood wins.
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
    std::size_t first;  // index of the hypothesis's first entry in choices_
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
  std::vector<DirectionPair> pairs_;  // within their individual gate
  std::vector<int> pairs_of_seen_, pairs_of_landmark_;
  Assignment assignment_;
  DirectionHypothesis hypothesis_;
  std::vector<int> landmark_of_;     // landmark of each direction in the present hypothesis
  std::vector<std::uint8_t> taken_;  // indexed by landmark
  std::vector<double> table_, alone_;
  std::vector<int> column_of_row_;
  std::vector<DirectionPair> assigned_;
  std::vector<Try> tries_;
  std::vector<int> choices_;  // landmarks chosen by all tries
  JointTest joint_test_;
  Workspace S_;
  std::vector<double> innovations_;
  std::vector<std::uint8_t> accepted_;
};

}  // namespace azimuth
