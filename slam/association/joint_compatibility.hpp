#pragma once
// Which bearing belongs to which landmark, judged jointly (Neira & Tardos 2001): errors of the robot's pose move all
// predictions together, so a set of pairings can be wrong although each of them passes its own gate.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/association/joint_beam.hpp"
#include "slam/geometry/workspace.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The azimuths under which the mapped landmarks are expected, with their joint covariance H P H^T.
struct PredictedAzimuths {
  std::span<const double> azimuth_rad;
  Eigen::Ref<const Eigen::MatrixXd> covariance;  ///< size x size, rad^2
  std::span<const Kind> kind = {};               ///< of each landmark; empty: all of any kind
};

struct MeasuredAzimuth {
  double azimuth_rad;
  double variance_rad2;
  Kind kind = kAnyKind;
};

struct JointGates {
  double individual_chi2 = 9.0;       ///< nu^2 / S of one pairing
  double joint_probability = 0.99;    ///< confidence of the joint test
  double new_density_per_rad = 0.16;  ///< how often a bearing is of something unmapped, per radian and bearing
  /// Hypotheses whose log-likelihoods differ from the best one's by less than this are its rivals; a bearing that a
  /// rival explains otherwise is ambiguous and is not paired. 0: the best hypothesis is always believed.
  double rival_log_ratio = 3.0;
  /// Hypotheses less likely than the best one by more than this need not be kept for those who ask for them.
  double keep_log_ratio = 0.0;
  int max_nodes = 20000;  ///< bound on the exact search; what the beam finds counts as well beyond (joint_beam.hpp)
  std::size_t beam_width = 256;  ///< of that
};

inline constexpr int kNoLandmark = -1;

/// The outcome for one bearing.
struct Pairing {
  int landmark = kNoLandmark;  ///< index into the predictions; kNoLandmark: of something unmapped, unless ambiguous
  bool ambiguous = false;      ///< a rival hypothesis explains this bearing otherwise
};

/// Branch and bound over joint hypotheses. A hypothesis explains every bearing, by a landmark (each is used at most
/// once) or as something new; it is judged by its likelihood, in which the first pairings of an uncertain pose count
/// little and those that confirm them count much. So a single bearing in the wide gate of a lost robot proves nothing.
///
/// Thread contract: thread-bound; workspace is kept between calls.
class JointCompatibility {
 public:
  /// Of the best one and its rivals so many are kept, the likeliest: what only less likely rivals explain otherwise is
  /// not ambiguous.
  static constexpr std::size_t kMostHypotheses = 32;

  /// One pairing per measurement in `out`.
  void associate(std::span<const MeasuredAzimuth> measured, const PredictedAzimuths& predicted, const JointGates& gates,
                 std::vector<Pairing>& out);

  // The likeliest hypotheses of the last call, best first; at least one.
  std::size_t kept() const { return kept_.size(); }
  double log_likelihood(std::size_t at) const { return kept_[at].log_likelihood; }
  /// A landmark or kNoLandmark for each measurement.
  std::span<const int> choices(std::size_t at) const;

 private:
  using Candidate = JointCandidate;
  /// Choices for every measurement, in a fixed block of choices_.
  struct Hypothesis {
    double log_likelihood;
    std::size_t block;
  };
  void find_candidates(const JointGates& gates);
  bool may_be(Kind kind, int landmark) const;
  void search(std::size_t measurement, int paired, double distance2, double log_likelihood);
  bool extend(std::size_t measurement, const Candidate& candidate, int paired, double& distance2,
              double& log_likelihood);
  double worth_keeping() const;
  void keep(double log_likelihood, std::span<const int> chosen);
  void search_by_beam();
  std::span<int> choices(const Hypothesis& hypothesis);

  std::span<const MeasuredAzimuth> measured_;
  const PredictedAzimuths* predicted_ = nullptr;
  JointGates gates_;
  std::vector<std::vector<Candidate>> candidates_;  // by measurement
  std::vector<double> best_possible_;               // log-likelihood the measurements from here on can add at most
  std::vector<int> chosen_;
  std::vector<std::size_t> rows_;  // measurement of each row of the running factor
  std::vector<std::uint8_t> used_;
  std::vector<double> quantile_;  // of chi-square, by pairings
  double quantile_probability_ = 0.0;
  std::vector<Hypothesis> kept_;  // best first
  std::vector<int> choices_;
  Eigen::MatrixXd L_;  // running Cholesky factor of the joint innovation covariance
  Eigen::VectorXd whitened_;
  int nodes_ = 0;
  JointBeam beam_;
  std::vector<double> variances_;
};

/// For pairings that are known: the largest subset that passes the joint test, found by leaving out the worst one at a
/// time.
///
/// Thread contract: thread-bound; does not allocate once its workspace has grown to the largest batch.
class JointTest {
 public:
  /// Innovations with joint covariance `S`; `accepted` gets one flag (0 or 1) each.
  void prune(std::span<const double> innovations, const Eigen::Ref<const Eigen::MatrixXd>& S, double joint_probability,
             std::vector<std::uint8_t>& accepted);

  /// The same for pairings that have `axes` innovations each (1 or 2), one after the other; one flag for each pairing.
  void prune(std::span<const double> innovations, int axes, const Eigen::Ref<const Eigen::MatrixXd>& S,
             double joint_probability, std::vector<std::uint8_t>& accepted);

 private:
  static Eigen::Index worst_of(const Eigen::Ref<const Eigen::VectorXd>& weighted,
                               const Eigen::Ref<const Eigen::MatrixXd>& inverse, int axes);

  Workspace factor_, weighted_, inverse_;
};

}  // namespace azimuth
