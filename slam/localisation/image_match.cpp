#include "slam/localisation/image_match.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kForbidden = -std::numeric_limits<double>::infinity();
constexpr double kLog2Pi = 1.8378770664093453;
constexpr double kCoarse = 0.4;       // larger tangents of an innovation are rejected without computing a covariance
constexpr double kTwoRowsGate = 3.0;  // enlargement of the squared gate for two degrees of freedom
constexpr int kSteps = 3;             // steps of least squares
constexpr int kAssignments = 3;       // assignments for a suggested pose, each from the pose found by the one before
constexpr double kRunaway_m = 5.0;
constexpr double kVague_m = 2.0;  // standard deviation of a suggested pose that counts as undetermined
// Assumed error of a suggested pose in its first assignment.
constexpr double kSuggested_m = 0.2, kSuggested_rad = 0.04;
constexpr float kFaintest = 1e-3f;  // lower limit of the probability that a landmark is still there

double log_determinant(const Appearance& seen, const Eigen::Matrix2d& S) {
  return seen.rows == 1 ? std::log(S(0, 0)) : std::log(S.determinant());
}

double squared(const Appearance& seen, const Eigen::Matrix2d& S) {
  if (seen.rows == 1) return seen.innovation.x() * seen.innovation.x() / S(0, 0);
  const Eigen::Vector2d& n = seen.innovation;
  return (S(1, 1) * n.x() * n.x() - 2.0 * S(0, 1) * n.x() * n.y() + S(0, 0) * n.y() * n.y()) / S.determinant();
}

double log_determinant(const Eigen::LLT<Eigen::Matrix3d>& llt) {
  return 2.0 * llt.matrixLLT().diagonal().array().log().sum();
}

Eigen::Vector3d difference(const Pose2& a, const Pose2& b) {
  return {a.x_m - b.x_m, a.y_m - b.y_m, wrap(a.heading_rad - b.heading_rad)};
}

/// Whether the pose is determined. Two directions without elevations leave a circle of poses, yet rounding may let even
/// this case be solved; such a pose must not be suggested.
bool is_fixed(const PoseGaussian& pose) { return pose.covariance.topLeftCorner<2, 2>().trace() < kVague_m * kVague_m; }

bool may_be_near(const SeenRay& ray, const Eigen::Vector3d& v) {
  const double s = ray.along.dot(v);
  return s > 0.0 && std::abs(ray.across.dot(v)) < kCoarse * s &&
         (!ray.spatial || std::abs(ray.up.dot(v)) < kCoarse * s);
}

}  // namespace

void MappedShare::learn(std::size_t mapped, std::size_t unmapped) {
  mapped_ += static_cast<double>(mapped);
  unmapped_ += static_cast<double>(unmapped);
  const double fading = std::min(1.0, kMemory / (mapped_ + unmapped_));
  mapped_ *= fading;
  unmapped_ *= fading;
}

std::optional<Compared> ImageMatch::compare(const KnownMap& map, const RaysOfImage& image,
                                            const PoseGaussian& predicted, Beliefs& beliefs, int assignments) {
  const Eigen::LLT<Eigen::Matrix3d> llt(predicted.covariance);
  if (llt.info() != Eigen::Success || !predicted.covariance.allFinite()) return std::nullopt;
  std::optional<Solution> solution = Solution{predicted};
  for (int i = 0; i < assignments; ++i) {
    look(map, solution->pose.T_map_body);
    assign(map, image, solution->pose, beliefs);
    solution = solve(map, image, predicted.T_map_body, &predicted);
    if (!solution) return std::nullopt;
  }
  Compared compared{solution->pose, odds_of_pairings(map, image, beliefs), 0.0, static_cast<int>(pairings_.size())};
  // ln |2 pi S| of all innovations together, by the matrix determinant lemma
  compared.log_odds -= 0.5 * (solution->log_noise + log_determinant(llt) + solution->log_information + solution->chi2);
  compared.log_odds += odds_of_misses(map, beliefs.lit);
  beliefs.share.learn(pairings_.size(), image.rays.size() - pairings_.size());
  return compared;
}

std::optional<Compared> ImageMatch::compare_suggested(const KnownMap& map, const RaysOfImage& image,
                                                      const Pose2& suggested, Beliefs& beliefs) {
  PoseGaussian pose{suggested, Eigen::Vector3d(kSuggested_m * kSuggested_m, kSuggested_m * kSuggested_m,
                                               kSuggested_rad * kSuggested_rad)
                                   .asDiagonal()};
  std::optional<Solution> solution;
  for (int i = 0; i < kAssignments; ++i) {
    look(map, pose.T_map_body);
    assign(map, image, pose, beliefs);
    solution = solve(map, image, pose.T_map_body, nullptr);
    if (!solution) return std::nullopt;
    pose = solution->pose;
  }
  if (!map.contains(pose.T_map_body) || !is_fixed(pose)) return std::nullopt;
  Compared compared{pose, odds_of_pairings(map, image, beliefs), 0.0, static_cast<int>(pairings_.size())};
  // Laplace's approximation of the integral over all poses
  compared.log_prior = map.log_prior_density + 1.5 * kLog2Pi - 0.5 * solution->log_information;
  compared.log_odds -= 0.5 * (solution->log_noise + solution->chi2);
  compared.log_odds += odds_of_misses(map, beliefs.lit);
  beliefs.share.learn(pairings_.size(), image.rays.size() - pairings_.size());
  return compared;
}

/// Lists the landmarks in view from a pose.
void ImageMatch::look(const KnownMap& map, const Pose2& T_map_body) {
  seen_.clear();
  const CameraPlace from(T_map_body, map.view.height_m);
  for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
    const Eigen::Vector3d v = from(map.landmarks[i]);
    const InView visible = in_view(map, map.landmarks[i], v);
    if (visible != InView::no) seen_.push_back({i, v, visible, false});
  }
  in_view_ = std::max<double>(1.0, static_cast<double>(seen_.size()));
}

/// Log odds that the camera detects a landmark in view (mathematics VI.8). If the detection probability is unknown: the
/// log of the learnt share of mapped directions, divided by the number of landmarks in view.
double ImageMatch::log_detected(const KnownMap& map, const Seen& seen, const Beliefs& beliefs) const {
  const double p = map.view.detection_probability;
  if (p <= 0.0) return std::log(beliefs.share.value() / in_view_);
  if (seen.in_view == InView::at_the_rim) return 0.0;
  const double detected = p * static_cast<double>(beliefs.lit[seen.landmark]);
  return std::log(detected / (1.0 - detected));
}

double ImageMatch::value_of(const KnownMap& map, const RaysOfImage& image, std::size_t ray, const Seen& seen,
                            const PoseGaussian& pose, const Beliefs& beliefs) const {
  const KnownLandmark& landmark = map.landmarks[seen.landmark];
  if (!may_be(image.rays[ray].seen, landmark) || !may_be_near(image.rays[ray], seen.from_camera)) return kForbidden;
  const auto expected = appearance(pose.T_map_body, image.rays[ray], landmark, map.view.height_m);
  if (!expected) return kForbidden;
  const Eigen::Matrix2d S = expected->by_pose * pose.covariance * expected->by_pose.transpose() + expected->noise;
  const double chi2 = squared(*expected, S);
  const double gate = settings_.gate_sigmas * settings_.gate_sigmas + (expected->rows == 2 ? kTwoRowsGate : 0.0);
  if (!(chi2 < gate)) return kForbidden;
  const double value = log_detected(map, seen, beliefs) + image.log_room[ray] -
                       0.5 * (expected->rows * kLog2Pi + log_determinant(*expected, S) + chi2);
  return std::isfinite(value) ? value : kForbidden;
}

void ImageMatch::assign(const KnownMap& map, const RaysOfImage& image, const PoseGaussian& pose,
                        const Beliefs& beliefs) {
  pairings_.clear();
  const std::size_t rows = image.rays.size(), columns = seen_.size();
  values_.resize(rows * columns);
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c)
      values_[r * columns + c] = value_of(map, image, r, seen_[c], pose, beliefs);
  const double log_rivals =
      map.view.detection_probability > 0.0 ? std::log(std::max<double>(1.0, static_cast<double>(rows))) : 0.0;
  alone_.assign(rows, std::log1p(-beliefs.share.value()) + log_rivals);
  assignment_.solve({values_, rows, columns}, alone_, Objective::maximise, column_of_row_);
  for (std::size_t r = 0; r < rows; ++r)
    if (column_of_row_[r] != kUnassigned) {
      Seen& seen = seen_[as_size(column_of_row_[r])];
      seen.hit = true;
      pairings_.push_back({r, seen.landmark});
    }
}

std::optional<ImageMatch::Solution> ImageMatch::solve(const KnownMap& map, const RaysOfImage& image, const Pose2& start,
                                                      const PoseGaussian* prior) const {
  const Eigen::Matrix3d prior_information =
      prior != nullptr ? Eigen::Matrix3d(prior->covariance.inverse()) : Eigen::Matrix3d::Zero();
  Solution solution{{start, {}}};
  Pose2& pose = solution.pose.T_map_body;
  for (int step = 0; step < kSteps; ++step) {
    const bool last = step + 1 == kSteps;
    const Eigen::Vector3d off = prior != nullptr ? difference(prior->T_map_body, pose) : Eigen::Vector3d::Zero();
    Eigen::Matrix3d information = prior_information;
    Eigen::Vector3d gradient = prior_information * off;
    solution.chi2 = off.dot(gradient);
    solution.log_noise = 0.0;
    for (const Pairing& pairing : pairings_) {
      const auto expected =
          appearance(pose, image.rays[pairing.ray], map.landmarks[pairing.landmark], map.view.height_m);
      if (!expected) return std::nullopt;
      const Eigen::Matrix2d W = expected->noise.inverse();
      information += expected->by_pose.transpose() * W * expected->by_pose;
      gradient += expected->by_pose.transpose() * W * expected->innovation;
      solution.chi2 += squared(*expected, expected->noise);
      solution.log_noise += expected->rows * kLog2Pi + log_determinant(*expected, expected->noise);
    }
    const Eigen::LLT<Eigen::Matrix3d> llt(information);
    if (llt.info() != Eigen::Success) return std::nullopt;
    solution.pose.covariance = llt.solve(Eigen::Matrix3d::Identity());
    solution.log_information = log_determinant(llt);
    if (last) break;
    const Eigen::Vector3d delta = llt.solve(gradient);
    if (!(delta.head<2>().norm() < kRunaway_m)) return std::nullopt;
    pose = {pose.x_m + delta.x(), pose.y_m + delta.y(), wrap(pose.heading_rad + delta.z())};
  }
  if (!solution.pose.covariance.allFinite()) return std::nullopt;
  return solution;
}

/// The log odds of the pairings without the densities, which are in Solution.
double ImageMatch::odds_of_pairings(const KnownMap& map, const RaysOfImage& image, const Beliefs& beliefs) const {
  const auto count = static_cast<double>(image.rays.size());
  const double log_rivals = map.view.detection_probability > 0.0 ? std::log(std::max(1.0, count)) : 0.0;
  double odds = (count - static_cast<double>(pairings_.size())) * std::log1p(-beliefs.share.value());
  for (const Pairing& pairing : pairings_) {
    const auto seen = std::ranges::find(seen_, pairing.landmark, &Seen::landmark);
    odds += log_detected(map, *seen, beliefs) + image.log_room[pairing.ray] - log_rivals;
  }
  return odds;
}

double ImageMatch::odds_of_misses(const KnownMap& map, LitOdds& lit) const {
  const double p = map.view.detection_probability;
  if (p <= 0.0) return 0.0;
  double odds = 0.0;
  for (const Seen& seen : seen_) {
    float& still_lit = lit[seen.landmark];
    const double missed = 1.0 - p * static_cast<double>(still_lit);
    // odds_of_pairings() holds the odds of a detection relative to this probability of a miss.
    if (seen.in_view == InView::yes) odds += std::log(missed);
    if (seen.hit)
      still_lit = 1.0f;
    else if (seen.in_view == InView::yes)
      still_lit = std::max(kFaintest, static_cast<float>(static_cast<double>(still_lit) * (1.0 - p) / missed));
  }
  return odds;
}

}  // namespace azimuth
