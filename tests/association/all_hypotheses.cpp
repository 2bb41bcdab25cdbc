#include "tests/association/all_hypotheses.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/association/chi_square.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

class Enumeration {
 public:
  Enumeration(std::span<const MeasuredAzimuth> measured, const PredictedAzimuths& predicted, const JointGates& gates)
      : measured_(measured), predicted_(predicted), gates_(gates) {}

  std::vector<JointHypothesis> run() {
    extend();
    std::sort(all_.begin(), all_.end(),
              [](const JointHypothesis& a, const JointHypothesis& b) { return a.log_likelihood > b.log_likelihood; });
    return std::move(all_);
  }

 private:
  void extend() {
    if (landmark_.size() == measured_.size()) {
      all_.push_back({*log_likelihood(), landmark_});
      return;
    }
    const auto landmarks = static_cast<int>(predicted_.azimuth_rad.size());
    for (int l = kNoLandmark; l < landmarks; ++l) {
      if (l != kNoLandmark && !may_be(l)) continue;
      if (l != kNoLandmark && std::find(landmark_.begin(), landmark_.end(), l) != landmark_.end()) continue;
      landmark_.push_back(l);
      if (log_likelihood()) extend();
      landmark_.pop_back();
    }
  }

  /// Whether the next measurement and the landmark may be of the same kind.
  bool may_be(int landmark) const {
    return predicted_.kind.empty() ||
           same_kind(measured_[landmark_.size()].kind, predicted_.kind[static_cast<std::size_t>(landmark)]);
  }

  double innovation(std::size_t measurement) const {
    const auto landmark = static_cast<std::size_t>(landmark_[measurement]);
    return wrap(measured_[measurement].azimuth_rad - predicted_.azimuth_rad[landmark]);
  }

  /// The log likelihood of the pairs decided so far; nullopt if a gate forbids one of them.
  std::optional<double> log_likelihood() const {
    std::vector<std::size_t> paired;
    for (std::size_t m = 0; m < landmark_.size(); ++m)
      if (landmark_[m] != kNoLandmark) paired.push_back(m);
    const auto size = static_cast<Eigen::Index>(paired.size());
    const double unpaired = static_cast<double>(landmark_.size() - paired.size());
    const double log_new = unpaired * std::log(gates_.new_density_per_rad);
    if (size == 0) return log_new;

    Eigen::MatrixXd S(size, size);
    Eigen::VectorXd nu(size);
    for (Eigen::Index r = 0; r < size; ++r) {
      const std::size_t m = paired[static_cast<std::size_t>(r)];
      for (Eigen::Index c = 0; c < size; ++c)
        S(r, c) = predicted_.covariance(landmark_[m], landmark_[paired[static_cast<std::size_t>(c)]]);
      S(r, r) += measured_[m].variance_rad2;
      nu(r) = innovation(m);
      if (nu(r) * nu(r) >= gates_.individual_chi2 * S(r, r)) return std::nullopt;
    }
    const double distance2 = nu.dot(S.ldlt().solve(nu));
    if (distance2 > chi_square_quantile(static_cast<int>(size), gates_.joint_probability)) return std::nullopt;
    return log_new - 0.5 * (distance2 + std::log(S.determinant()) + static_cast<double>(size) * std::log(2.0 * kPi));
  }

  std::span<const MeasuredAzimuth> measured_;
  const PredictedAzimuths& predicted_;
  JointGates gates_;
  std::vector<int> landmark_;
  std::vector<JointHypothesis> all_;
};

}  // namespace

std::vector<JointHypothesis> all_hypotheses(std::span<const MeasuredAzimuth> measured,
                                            const PredictedAzimuths& predicted, const JointGates& gates) {
  return Enumeration(measured, predicted, gates).run();
}

}  // namespace azimuth
