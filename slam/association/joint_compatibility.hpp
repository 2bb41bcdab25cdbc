#pragma once
// Joint data association of bearings with landmarks (Neira & Tardos 2001): errors of the robot's pose move all
// predictions together, so a set of pairs can be wrong although each pair passes its individual gate.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/association/joint_beam.hpp"
#include "slam/geometry/workspace.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The predicted azimuths of the mapped landmarks, with their joint covariance H P H^T.
struct PredictedAzimuths {
  std::span<const double> azimuth_rad;
  Eigen::Ref<const Eigen::MatrixXd> covariance;  ///< Size x size, rad^2
  std::span<const Kind> kind = {};               ///< Kind of each landmark; empty: all are kAnyKind
};

struct MeasuredAzimuth {
  double azimuth_rad;
  double variance_rad2;
  Kind kind = kAnyKind;
};

struct JointGates {
  double individual_chi2 = 9.0;       ///< nu^2 / S of one pair
  double joint_probability = 0.99;    ///< Confidence of the joint test
  double new_density_per_rad = 0.16;  ///< Density of bearings of unmapped landmarks, per radian and bearing
  /// Hypotheses within this log-likelihood of the best one are its rivals; a bearing that a rival explains differently
  /// is ambiguous and is not paired. 0: the best hypothesis is always used.
  double rival_log_ratio = 3.0;
  /// Hypotheses within this log-likelihood of the best one are kept for choices(), if they are not rivals anyway.
  double keep_log_ratio = 0.0;
  int max_nodes = 20000;         ///< Limit of the exact search; beyond it the beam search is added (joint_beam.hpp)
  std::size_t beam_width = 256;  ///< Width of the beam search
};

inline constexpr int kNoLandmark = -1;

/// The outcome for one bearing.
struct Pairing {
  int landmark = kNoLandmark;  ///< Index into the predictions; kNoLandmark: unmapped, unless ambiguous
  bool ambiguous = false;      ///< A rival hypothesis explains this bearing differently
};

/// Branch and bound over joint hypotheses. A hypothesis assigns every bearing to a landmark (each used at most once) or
/// to something new, and is ranked by its likelihood. With an uncertain pose the first pairs count little, and those
/// that confirm them count much; a single bearing in the wide gate of a lost robot therefore proves nothing.
///
/// Thread contract: thread-bound; workspace is kept between calls.
class JointCompatibility {
 public:
  /// Number of hypotheses kept: the best one and its most likely rivals. Differences to rivals that are not kept do not
  /// make a bearing ambiguous.
  static constexpr std::size_t kMostHypotheses = 32;

  /// Writes one pairing per measurement into `out`.
  void associate(std::span<const MeasuredAzimuth> measured, const PredictedAzimuths& predicted, const JointGates& gates,
                 std::vector<Pairing>& out);

  // The most likely hypotheses of the last call, best first; at least one.
  std::size_t kept() const { return kept_.size(); }
  double log_likelihood(std::size_t at) const { return kept_[at].log_likelihood; }
  /// A landmark or kNoLandmark for each measurement.
  std::span<const int> choices(std::size_t at) const;

 private:
  using Candidate = JointCandidate;
  /// The assignment of every measurement, stored in a fixed block of choices_.
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
  std::vector<std::vector<Candidate>> candidates_;  // indexed by measurement
  // indexed by measurement: upper bound of the log-likelihood that this measurement and all later ones can add
  std::vector<double> best_possible_;
  std::vector<int> chosen_;
  std::vector<std::size_t> rows_;  // measurement of each row of the present factor
  std::vector<std::uint8_t> used_;
  std::vector<double> quantile_;  // chi-square quantile, by number of pairs
  double quantile_probability_ = 0.0;
  std::vector<Hypothesis> kept_;  // best first
  std::vector<int> choices_;
  Eigen::MatrixXd L_;  // present Cholesky factor of the joint innovation covariance
  Eigen::VectorXd whitened_;
  int nodes_ = 0;
  JointBeam beam_;
  std::vector<double> variances_;
};

/// For known pairs: finds a large subset that passes the joint test by leaving out the worst pair at a time.
///
/// Thread contract: thread-bound; does not allocate once its workspace has grown to the largest batch.
class JointTest {
 public:
  /// Takes innovations with joint covariance `S`; `accepted` gets one flag (0 or 1) per innovation.
  void prune(std::span<const double> innovations, const Eigen::Ref<const Eigen::MatrixXd>& S, double joint_probability,
             std::vector<std::uint8_t>& accepted);

  /// Variant for pairs that have `axes` (1 or 2) consecutive innovations each; `accepted` gets one flag per pair.
  void prune(std::span<const double> innovations, int axes, const Eigen::Ref<const Eigen::MatrixXd>& S,
             double joint_probability, std::vector<std::uint8_t>& accepted);

 private:
  static Eigen::Index worst_of(const Eigen::Ref<const Eigen::VectorXd>& weighted,
                               const Eigen::Ref<const Eigen::MatrixXd>& inverse, int axes);

  Workspace factor_, weighted_, inverse_;
};

}  // namespace azimuth
