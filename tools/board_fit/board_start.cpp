#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <utility>

#include "tools/board_fit/board_equations.hpp"
#include "tools/board_fit/board_fit.hpp"

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

}  // namespace

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
