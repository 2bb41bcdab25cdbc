#pragma once
// Beam search for joint hypotheses, for images with too many bearings for branch and bound.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace azimuth {

/// A landmark that a bearing may belong to, and the innovation of that pair.
struct JointCandidate {
  int landmark;
  double innovation;
};

/// Extends the most likely partial hypotheses bearing by bearing, starting with the most certain predictions: these
/// determine the robot's pose, and hence the associations of the others. Unlike branch and bound the search may miss
/// the best hypothesis, but only one that looked unlikely early on; its time is bounded by `width` extensions of each
/// bearing's candidates.
///
/// Thread contract: thread-bound; workspace is kept between calls.
class JointBeam {
 public:
  struct Problem {
    std::span<const std::vector<JointCandidate>> candidates;  ///< Candidates of each bearing
    std::span<const double> variance_rad2;                    ///< Measurement noise of each bearing
    Eigen::Ref<const Eigen::MatrixXd> covariance;             ///< Covariance of the predicted azimuths, rad^2
    std::span<const double> quantile;                         ///< Chi-square quantile, by number of pairs
    double log_new;                                           ///< Log-likelihood of a bearing of an unmapped landmark
    std::size_t width;                                        ///< Partial hypotheses carried on, at least 1
  };

  void search(const Problem& problem);

  /// Complete hypotheses, best first.
  std::size_t size() const { return now_.size(); }
  double log_likelihood(std::size_t at) const { return now_[at].log_likelihood; }
  /// The landmark of each bearing; negative: none.
  std::span<const int> choices(std::size_t at) const;

 private:
  /// A hypothesis for the bearings processed so far; its details are in a block of the layer's storage.
  struct Partial {
    double log_likelihood, distance2;
    std::size_t block;
    int paired;
  };
  /// A possible extension of a partial hypothesis by one bearing.
  struct Child {
    double log_likelihood, distance2;
    std::size_t parent;
    int landmark;
    double pivot, whitened;
  };
  struct Layer {
    std::vector<int> choice, row;  // indexed by block: landmark of each bearing, landmark of each row of the factor
    std::vector<double> factor;    // indexed by block: lower triangle, row by row
    std::vector<double> whitened;
  };
  void order_bearings(const Problem& problem);
  void branch(const Problem& problem, std::size_t bearing);
  void pair(const Problem& problem, std::size_t parent, const JointCandidate& candidate, double variance_rad2);
  void carry_on(const Problem& problem, std::size_t bearing);
  void write(const Problem& problem, const Child& child, std::size_t bearing);
  bool is_used(const Partial& partial, int landmark) const;
  std::span<const double> next_row(const Problem& problem, const Partial& partial, int landmark);
  void grow(std::size_t bearings, std::size_t width);

  std::size_t bearings_ = 0, triangle_ = 0;
  std::vector<std::size_t> order_;
  std::vector<double> surest_;
  std::vector<Partial> now_, next_;
  std::vector<Child> children_;
  std::array<Layer, 2> layers_;
  std::size_t at_ = 0;  // the layer of now_
  std::vector<double> solved_;
};

}  // namespace azimuth
