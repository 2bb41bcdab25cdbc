#include "tools/board_fit/board_fit.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace azimuth {
namespace {

/// Pose from a homography H = (h1, h2, h3) up to scale: (R1, R2, t) = H / |h|, where R is the rotation nearest to
/// (h1, h2, h1 x h2).
std::optional<Eigen::Isometry3d> pose_of(const Eigen::Matrix3d& H) {
  const double scale = 0.5 * (H.col(0).norm() + H.col(1).norm());
  Eigen::Matrix3d axes;
  axes << H.col(0) / scale, H.col(1) / scale, H.col(0).cross(H.col(1)) / (scale * scale);
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = svd.matrixU() * svd.matrixV().transpose();
  pose.translation() = H.col(2) / scale;
  if (!pose.matrix().allFinite() || pose.linear().determinant() < 0.0) return std::nullopt;
  return pose;
}

constexpr int kOfBoard = 6;

constexpr double kHeld = 1e-6;  // standard deviation of the rotation about the lens axis, which is fixed

class BoardEquations {
 public:
  BoardEquations(const Chessboard& board, const std::vector<BoardSighting>& sightings, const BoardSolution& at)
      : board_(board), sightings_(sightings), at_(at) {}

  FitEquations all() {
    entries_.emplace_back(0, kLensNumbers - 1, 1.0 / kHeld);
    errors_.push_back(0.0);
    for (std::size_t k = 0; k < sightings_.size(); ++k)
      for (std::size_t i = 0; i < board_.corners(); ++i) see(k, i);
    const auto unknowns = kLensNumbers + kOfBoard * as_index(sightings_.size());
    out_.J.resize(as_index(errors_.size()), unknowns);
    out_.J.setFromTriplets(entries_.begin(), entries_.end());
    out_.e = Eigen::Map<const Eigen::VectorXd>(errors_.data(), as_index(errors_.size()));
    return std::move(out_);
  }

 private:
  /* A corner at b on a board with rotation R and translation t is at p = R b + t. For a small rotation w in the
   * camera's frame, d p / d w = -[R b]x and d p / d t = 1.
   */
  void see(std::size_t sighting, std::size_t corner) {
    const Eigen::Isometry3d& pose = at_.T_camera_board[sighting];
    const Eigen::Vector3d turned = pose.linear() * board_.corner(corner);
    const Pixel& seen = sightings_[sighting].corners[corner];
    const auto image = at_.lens.image(turned + pose.translation(), at_.lens.axes.polar(seen).radius_px);
    if (!image) return lose();
    const Eigen::Vector2d off_px = image->pixel - seen;
    const double mahalanobis2 = off_px.squaredNorm() / (at_.sigma_px * at_.sigma_px);
    const double scale = std::sqrt(cauchy_weight(mahalanobis2)) / at_.sigma_px;
    const Eigen::Matrix3d by_turn{
        {0.0, turned.z(), -turned.y()}, {-turned.z(), 0.0, turned.x()}, {turned.y(), -turned.x(), 0.0}};
    const int first = kLensNumbers + kOfBoard * static_cast<int>(sighting);
    put(0, scale * image->by_lens);
    put(first, scale * image->by_point * by_turn);
    put(first + 3, scale * image->by_point);
    for (const double each : off_px) errors_.push_back(scale * each);
    out_.cost += cauchy_cost(mahalanobis2);
    out_.mahalanobis2.push_back(mahalanobis2);
    out_.error_px.push_back(off_px.norm());
  }
  template <class Matrix>
  void put(int column, const Matrix& expression) {
    const Eigen::Matrix<double, 2, Matrix::ColsAtCompileTime> block = expression;
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < block.cols(); ++k)
        entries_.emplace_back(static_cast<int>(errors_.size()) + i, column + k, block(i, k));
  }
  void lose() {
    out_.cost += lost_cost();
    out_.mahalanobis2.push_back(std::numeric_limits<double>::infinity());
    out_.error_px.push_back(std::numeric_limits<double>::quiet_NaN());
  }

  const Chessboard& board_;
  const std::vector<BoardSighting>& sightings_;
  const BoardSolution& at_;
  FitEquations out_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> errors_;
};

constexpr double kLeastSigma_px = 0.01;
constexpr double kFirstSigma_px = 3.0;  // initial corner noise, while the lens is inaccurate
constexpr int kRounds = 4;              // each round estimates the corner noise again

/// Standard deviation along one axis from the median of the distances: half of all distances are below 1.1774 standard
/// deviations.
double robust_sigma_px(std::vector<double> error_px) {
  std::erase_if(error_px, [](double each) { return !std::isfinite(each); });
  if (error_px.empty()) return kFirstSigma_px;
  const auto middle = error_px.begin() + as_index(error_px.size() / 2);
  std::nth_element(error_px.begin(), middle, error_px.end());
  return std::max(kLeastSigma_px, *middle / 1.1774);
}

}  // namespace

FitEquations board_equations(const Chessboard& board, const std::vector<BoardSighting>& sightings,
                             const BoardSolution& at) {
  return BoardEquations(board, sightings, at).all();
}

BoardSolution board_moved(BoardSolution from, const Eigen::VectorXd& by) {
  from.lens = from.lens.moved(by.head<kLensNumbers>());
  Eigen::Index next = kLensNumbers;
  for (Eigen::Isometry3d& pose : from.T_camera_board) {
    const Eigen::Vector3d turn = by.segment<3>(next);
    const double angle = turn.norm();
    if (angle > 0.0) pose.linear() = Eigen::AngleAxisd(angle, turn / angle) * pose.linear();
    pose.translation() += by.segment<3>(next + 3);
    next += kOfBoard;
  }
  return from;
}

double BoardSolution::rms_px() const { return azimuth::rms_px(error_px, fits); }

double BoardSolution::fitting() const { return share(fits); }

std::optional<BoardSolution> fit_boards(const Chessboard& board, const std::vector<BoardSighting>& sightings,
                                        const BoardSolution& start) {
  BoardSolution solution = start;
  solution.sigma_px = kFirstSigma_px;
  const auto equations_at = [&](const BoardSolution& at) { return board_equations(board, sightings, at); };
  FitEquations equations;
  for (int round = 0; round < kRounds; ++round) {
    auto found = settled(std::move(solution), equations_at, board_moved);
    if (!found) return std::nullopt;
    solution = std::move(found->at);
    equations = std::move(found->equations);
    if (round + 1 < kRounds) solution.sigma_px = robust_sigma_px(equations.error_px);
  }
  const auto covariance = leading_covariance(equations, kLensNumbers);
  if (!covariance) return std::nullopt;
  const double unknowns = 6.0 * static_cast<double>(sightings.size()) + kLensNumbers - 1;
  SightingWeights weights = weigh(equations.mahalanobis2, unknowns);
  solution.sigma_px *= std::sqrt(weights.unit_variance);
  solution.covariance = weights.unit_variance * *covariance;
  solution.covariance.row(kLensNumbers - 1).setZero();
  solution.covariance.col(kLensNumbers - 1).setZero();
  solution.error_px = std::move(equations.error_px);
  solution.fits = std::move(weights.fits);
  return solution;
}

/* The viewing ray l of a board point (x, y) is parallel to H (x, y, 1): l x H (x, y, 1) = 0, which is linear in H. Of
 * the two possible signs of H, the one with the board in front of the lens is right.
 */
std::optional<Eigen::Isometry3d> board_pose(const Lens& lens, const Chessboard& board,
                                            const std::vector<Pixel>& corners) {
  Eigen::Matrix<double, Eigen::Dynamic, 9> rows(3 * as_index(corners.size()), 9);
  rows.setZero();
  std::vector<Eigen::Vector3d> rays;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d& ray = rays.emplace_back(lens.ray(corners[i]).normalized());
    const Eigen::Vector3d at = board.corner(i) / board.square_m;
    const Eigen::Matrix3d cross{{0.0, -ray.z(), ray.y()}, {ray.z(), 0.0, -ray.x()}, {-ray.y(), ray.x(), 0.0}};
    for (int k = 0; k < 3; ++k) rows.block<3, 3>(3 * as_index(i), 3 * k) = cross * (k < 2 ? at[k] : 1.0);
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeThinV);
  Eigen::Matrix3d H = svd.matrixV().col(8).reshaped(3, 3);
  double along = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d at = board.corner(i) / board.square_m;
    along += rays[i].dot(H * Eigen::Vector3d(at.x(), at.y(), 1.0));
  }
  if (along < 0.0) H = -H;
  auto pose = pose_of(H);
  if (pose) pose->translation() *= board.square_m;
  return pose;
}

std::optional<BoardSolution> board_start(const std::vector<Lens>& starts, const Chessboard& board,
                                         const std::vector<BoardSighting>& sightings) {
  std::optional<BoardSolution> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Lens& lens : starts) {
    BoardSolution start{.lens = lens, .T_camera_board = {}, .sigma_px = 3.0, .error_px = {}, .fits = {}};
    for (const BoardSighting& each : sightings)
      if (const auto pose = board_pose(lens, board, each.corners)) start.T_camera_board.push_back(*pose);
    if (start.T_camera_board.size() < sightings.size()) continue;
    const double cost = board_equations(board, sightings, start).cost;
    if (!(cost < least)) continue;
    least = cost;
    best = std::move(start);
  }
  return best;
}

}  // namespace azimuth
