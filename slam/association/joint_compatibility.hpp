#pragma once
// Which bearing belongs to which landmark, judged jointly (Neira & Tardos 2001): errors of the robot's pose move all
// predictions together, so a set of pairings can be wrong although each of them passes its own gate.

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace azimuth {

/// The azimuths under which the mapped landmarks are expected, with their joint covariance H P H^T.
struct PredictedAzimuths {
  std::span<const double> azimuth_rad;
  Eigen::Ref<const Eigen::MatrixXd> covariance;  ///< size x size, rad^2
};

struct MeasuredAzimuth {
  double azimuth_rad;
  double variance_rad2;
};

struct JointGates {
  double individual_chi2 = 9.0;     ///< nu^2 / S of one pairing
  double joint_probability = 0.99;  ///< confidence of the joint test
  int max_nodes = 20000;            ///< bound on the search; the best hypothesis so far is returned beyond
  /// A landmark that explains a bearing nearly as well as the chosen one makes the pairing ambiguous: the hypotheses'
  /// squared distances differ by less than this. Ambiguous bearings pair with nothing. 0: never.
  double ambiguity_chi2 = 0.0;
};

inline constexpr int kNoLandmark = -1;

/// The outcome for one bearing.
struct Pairing {
  int landmark = kNoLandmark;  ///< index into the predictions
  bool ambiguous = false;      ///< left unpaired because a rival hypothesis is as good
  bool near_a_landmark = false;///< within an individual gate of some landmark: not evidence of a new one
};

/// Branch and bound over joint hypotheses: the most pairings, then the smallest joint squared distance. One pairing
/// per measurement in `out`; each landmark is used at most once.
///
/// Thread contract: thread-bound; workspace is kept between calls.
class JointCompatibility {
 public:
  void associate(std::span<const MeasuredAzimuth> measured, const PredictedAzimuths& predicted, const JointGates& gates,
                 std::vector<Pairing>& out);

  /// For pairings already known: the largest subset that passes the joint test, found by leaving out the worst one at
  /// a time. `innovations` with covariance `S`; `accepted` gets one flag each.
  static void prune(std::span<const double> innovations, const Eigen::Ref<const Eigen::MatrixXd>& S,
                    double joint_probability, std::vector<bool>& accepted);

 private:
  struct Candidate {
    int landmark;
    double innovation;
  };
  void search(std::size_t measurement, int paired, double distance2);
  bool extend(std::size_t measurement, const Candidate& candidate, int paired, double& distance2);
  void record(int paired, double distance2);

  std::span<const MeasuredAzimuth> measured_;
  const PredictedAzimuths* predicted_ = nullptr;
  JointGates gates_;
  std::vector<std::vector<Candidate>> candidates_;  // by measurement
  std::vector<int> chosen_, best_, rival_;
  std::vector<std::size_t> rows_;      // measurement of each row of the running factor
  std::vector<bool> used_;
  std::vector<double> quantile_;       // of chi-square, by pairings
  Eigen::MatrixXd L_;                  // running Cholesky factor of the joint innovation covariance
  Eigen::VectorXd whitened_;
  int best_paired_ = -1, rival_paired_ = -1, nodes_ = 0;
  double best_distance2_ = 0.0, rival_distance2_ = 0.0;
};

}  // namespace azimuth
