#include "slam/hypotheses/same_landmarks.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

constexpr double kApart = -std::numeric_limits<double>::infinity();

using Matrix24d = Eigen::Matrix<double, 2, 4>;

/// Difference of `vague` and `other` in the chart of `vague`, with derivatives by both.
struct ChartDifference {
  Eigen::Vector2d off;
  Matrix24d by_both;  // by vague (2), by other (2)
};

std::optional<ChartDifference> chart_difference(const SmoothedLandmark& vague, const SmoothedLandmark& other) {
  if (!other.is_point()) return std::nullopt;
  const Eigen::Vector2d away = other.p_map() - vague.p_map_chart;
  const double distance_m = away.norm();
  constexpr double kTooNear_m = 0.05;
  if (distance_m < kTooNear_m) return std::nullopt;
  const Eigen::Vector2d u = away / distance_m;
  ChartDifference result;
  result.off = {wrap(vague.direction_rad - std::atan2(u.y(), u.x())), vague.inverse_distance_per_m - 1.0 / distance_m};
  Eigen::Matrix2d by_place;
  by_place << -u.y() / distance_m, u.x() / distance_m,  //
      -u.x() / (distance_m * distance_m), -u.y() / (distance_m * distance_m);
  result.by_both << Eigen::Matrix2d::Identity(), -by_place * other.p_by_chart();
  return result;
}

/// The rounds of one call of same_landmarks().
class Comparison {
 public:
  Comparison(LandmarkBeliefs beliefs, std::span<const LandmarkPair> possible, const SameLandmarksSettings& settings)
      : beliefs_(std::move(beliefs)), possible_(possible), settings_(settings), taken_(beliefs_.landmarks.size(), 0) {}

  std::vector<LandmarkPair> run() {
    std::vector<LandmarkPair> same;
    for (;;) {
      score_all();
      const std::size_t best = clearest();
      if (best == possible_.size()) return same;
      same.push_back(possible_[best]);
      condition(possible_[best]);
      taken_[possible_[best].newer] = 1;
    }
  }

 private:
  struct Innovation {
    Eigen::Vector2d off;
    Eigen::Matrix2d S;
    std::size_t vague = 0, other = 0;
    Matrix24d by_both;
  };

  double rho_variance(std::size_t i) const {
    const auto row = static_cast<Eigen::Index>(2 * i + 1);
    return beliefs_.covariance(row, row);
  }

  std::optional<Innovation> compare(const LandmarkPair& pair) const {
    Innovation result;
    const bool newer_is_vaguer = rho_variance(pair.newer) >= rho_variance(pair.older);
    result.vague = newer_is_vaguer ? pair.newer : pair.older;
    result.other = newer_is_vaguer ? pair.older : pair.newer;
    const auto difference = chart_difference(beliefs_.landmarks[result.vague], beliefs_.landmarks[result.other]);
    if (!difference) return std::nullopt;
    result.off = difference->off;
    result.by_both = difference->by_both;
    const auto v = static_cast<Eigen::Index>(2 * result.vague), o = static_cast<Eigen::Index>(2 * result.other);
    Eigen::Matrix4d P;
    P << beliefs_.covariance.block<2, 2>(v, v), beliefs_.covariance.block<2, 2>(v, o),  //
        beliefs_.covariance.block<2, 2>(o, v), beliefs_.covariance.block<2, 2>(o, o);
    result.S = result.by_both * P * result.by_both.transpose();
    result.S.diagonal().array() += 1e-12;
    return result;
  }

  /// Score of a pair; kApart: the two are separate landmarks.
  double score(const LandmarkPair& pair) const {
    const auto innovation = compare(pair);
    if (!innovation) return kApart;
    const double chi2 = innovation->off.dot(innovation->S.inverse() * innovation->off);
    if (!(chi2 < settings_.gate_chi2)) return kApart;
    const double log_two_pi = std::log(2.0 * std::numbers::pi);
    const double log_same = -0.5 * (chi2 + std::log(innovation->S.determinant())) - log_two_pi;
    const double sigma = settings_.inverse_depth_sigma_per_m;
    const double off =
        (beliefs_.landmarks[innovation->vague].inverse_distance_per_m - settings_.inverse_depth_mean_per_m) / sigma;
    const double log_chance = settings_.log_new - 0.5 * (off * off + log_two_pi) - std::log(sigma);
    return settings_.log_detection + log_same - log_chance;
  }

  void score_all() {
    scores_.clear();
    for (const LandmarkPair& pair : possible_)
      scores_.push_back(taken_[pair.newer] != 0 || taken_[pair.older] != 0 ? kApart : score(pair));
  }

  bool could_be_one(std::size_t a, std::size_t b) const {
    const LandmarkPair pair{std::min(a, b), std::max(a, b)};
    const auto found = std::find(possible_.begin(), possible_.end(), pair);
    return found != possible_.end() && scores_[static_cast<std::size_t>(found - possible_.begin())] != kApart;
  }

  /// Index of the pair with the largest margin; possible_.size() when no pair is clear.
  std::size_t clearest() const {
    std::size_t best = possible_.size();
    double best_margin = settings_.min_margin;
    for (std::size_t i = 0; i < possible_.size(); ++i) {
      if (!(scores_[i] > best_margin)) continue;
      double rival = 0.0;
      for (std::size_t j = 0; j < possible_.size(); ++j) {
        if (j == i || !(scores_[j] > rival)) continue;
        const LandmarkPair &mine = possible_[i], &other = possible_[j];
        const auto shares = [&](std::size_t shared, std::size_t own) {
          if (other.older != shared && other.newer != shared) return false;
          const std::size_t third = other.older == shared ? other.newer : other.older;
          return !could_be_one(own, third);
        };
        if (shares(mine.older, mine.newer) || shares(mine.newer, mine.older)) rival = scores_[j];
      }
      if (scores_[i] - rival >= best_margin) {
        best_margin = scores_[i] - rival;
        best = i;
      }
    }
    return best;
  }

  void condition(const LandmarkPair& pair) {
    const auto innovation = compare(pair);
    const auto v = static_cast<Eigen::Index>(2 * innovation->vague),
               o = static_cast<Eigen::Index>(2 * innovation->other);
    const Eigen::MatrixXd PH = beliefs_.covariance.middleCols<2>(v) * innovation->by_both.leftCols<2>().transpose() +
                               beliefs_.covariance.middleCols<2>(o) * innovation->by_both.rightCols<2>().transpose();
    const Eigen::Matrix2d inverse = innovation->S.inverse();
    const Eigen::VectorXd step = -PH * (inverse * innovation->off);
    beliefs_.covariance -= PH * inverse * PH.transpose();
    for (std::size_t i = 0; i < beliefs_.landmarks.size(); ++i)
      beliefs_.landmarks[i] = beliefs_.landmarks[i].moved(step.segment<2>(static_cast<Eigen::Index>(2 * i)));
  }

  LandmarkBeliefs beliefs_;
  std::span<const LandmarkPair> possible_;
  const SameLandmarksSettings& settings_;
  std::vector<char> taken_;
  std::vector<double> scores_;
};

}  // namespace

std::vector<LandmarkPair> same_landmarks(LandmarkBeliefs beliefs, std::span<const LandmarkPair> possible,
                                         const SameLandmarksSettings& settings) {
  return Comparison(std::move(beliefs), possible, settings).run();
}

}  // namespace azimuth
