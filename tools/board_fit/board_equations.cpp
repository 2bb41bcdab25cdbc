#include "tools/board_fit/board_equations.hpp"

#include <cmath>
#include <limits>

namespace azimuth {
namespace {

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

}  // namespace azimuth
