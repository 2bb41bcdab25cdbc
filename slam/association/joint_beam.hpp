#pragma once
// Joint hypotheses by breadth: for images that show more than branch and bound gets through.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace azimuth {

/// What a bearing may be of: a mapped landmark, and how far from it the bearing is.
struct JointCandidate {
  int landmark;
  double innovation;
};

/// Carries the likeliest partial hypotheses from bearing to bearing, those with the surest predictions first: they tell
/// where the robot is, and so what the others can be. It may miss the best one, which branch and bound cannot, but its
/// time is bounded by `width` extensions of each bearing's candidates, and what it misses is unlikely from early on.
///
/// Thread contract: thread-bound; workspace is kept between calls.
class JointBeam {
 public:
  struct Problem {
    std::span<const std::vector<JointCandidate>> candidates;  ///< of each bearing
    std::span<const double> variance_rad2;                    ///< likewise, of the bearing itself
    Eigen::Ref<const Eigen::MatrixXd> covariance;             ///< of the predicted azimuths, rad^2
    std::span<const double> quantile;                         ///< of chi-square, by pairings
    double log_new;                                           ///< log-likelihood of a bearing of something unmapped
    std::size_t width;                                        ///< partial hypotheses carried on, at least 1
  };

  void search(const Problem& problem);

  /// Whole hypotheses, best first.
  std::size_t size() const { return now_.size(); }
  double log_likelihood(std::size_t at) const { return now_[at].log_likelihood; }
  /// The landmark of each bearing; negative: none.
  std::span<const int> choices(std::size_t at) const;

 private:
  /// A hypothesis for the bearings up to here, in a block of the layer's storage.
  struct Partial {
    double log_likelihood, distance2;
    std::size_t block;
    int paired;
  };
  /// One that may come of it.
  struct Child {
    double log_likelihood, distance2;
    std::size_t parent;
    int landmark;
    double pivot, whitened;
  };
  struct Layer {
    std::vector<int> choice, row;  // by block: of each bearing; the landmark of each row of the factor
    std::vector<double> factor;    // by block: lower triangle, row by row
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
