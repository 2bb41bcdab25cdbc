#include "tests/support/rendered_boards.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth::test {
namespace {

constexpr double kEdge = 1.0;  // white border around the squares, in squares
constexpr double kBlack = 25.0, kWhite = 215.0, kWall = 120.0;
constexpr int kSamples = 4;  // per pixel and axis

/// Distance from the board's centre to its edge, in squares: `corners` + 1 squares per axis.
double reach(int corners) { return 0.5 * (corners + 1); }

/// Grey level along a ray.
double grey(const Chessboard& board, const Eigen::Isometry3d& T_board_camera, const Eigen::Vector3d& ray) {
  const Eigen::Vector3d from = T_board_camera.translation(), along = T_board_camera.linear() * ray;
  const double far = -from.z() / along.z();
  const Eigen::Vector3d at = (from + far * along) / board.square_m;
  if (!(far > 0.0) || std::abs(at.x()) > reach(board.columns) + kEdge || std::abs(at.y()) > reach(board.rows) + kEdge)
    return kWall + 40.0 * std::sin(5.0 * ray.x()) * std::sin(7.0 * ray.y());
  const bool inside = std::abs(at.x()) < reach(board.columns) && std::abs(at.y()) < reach(board.rows);
  const int column = static_cast<int>(std::floor(at.x() + reach(board.columns)));
  const int row = static_cast<int>(std::floor(at.y() + reach(board.rows)));
  const double light = 1.0 + 0.02 * at.x();
  return light * (inside && (column + row) % 2 == 0 ? kBlack : kWhite);
}

std::vector<Eigen::Vector3d> outline(const Chessboard& board) {
  std::vector<Eigen::Vector3d> points;
  const double x = reach(board.columns) + kEdge, y = reach(board.rows) + kEdge;
  for (int i = 0; i <= 8; ++i) {
    const double share = 0.25 * i - 1.0;
    for (const double side : {-1.0, 1.0}) {
      points.emplace_back(share * x, side * y, 0.0);
      points.emplace_back(side * x, share * y, 0.0);
    }
  }
  for (Eigen::Vector3d& point : points) point *= board.square_m;
  return points;
}

}  // namespace

bool is_in_image(const CameraModel& camera, int side_px, const Chessboard& board,
                 const Eigen::Isometry3d& T_camera_board) {
  return std::ranges::all_of(outline(board), [&](const Eigen::Vector3d& point) {
    const auto pixel = camera.pixel(Eigen::Vector3d(T_camera_board * point));
    return pixel && pixel->minCoeff() > 2.0 && pixel->maxCoeff() < side_px - 3.0;
  });
}

GreyImage rendered(const CameraModel& camera, int side_px, const Chessboard& board,
                   const Eigen::Isometry3d& T_camera_board, double sigma_grey, std::mt19937_64& random) {
  const Eigen::Isometry3d T_board_camera = T_camera_board.inverse();
  Eigen::AlignedBox2d near;
  for (const Eigen::Vector3d& point : outline(board))
    near.extend(*camera.pixel(Eigen::Vector3d(T_camera_board * point)));
  near.min().array() -= 3.0;
  near.max().array() += 3.0;
  std::normal_distribution<double> noise(0.0, sigma_grey);
  GreyImage image{packed_format(PixelFormat::gray8, side_px, side_px), {}};
  for (int v = 0; v < side_px; ++v)
    for (int u = 0; u < side_px; ++u) {
      double sum = 0.0;
      const int samples = near.contains(Pixel(u, v)) ? kSamples : 1;
      for (int i = 0; i < samples * samples; ++i) {
        const Pixel off((i % samples + 0.5) / samples - 0.5, (i / samples + 0.5) / samples - 0.5);
        const auto ray = camera.ray(Pixel(Pixel(u, v) + off));
        sum += ray ? grey(board, T_board_camera, *ray) : 0.0;
      }
      const double level = sum / (samples * samples) + noise(random);
      image.bytes.push_back(static_cast<std::byte>(std::lround(std::clamp(level, 0.0, 255.0))));
    }
  return image;
}

Eigen::Isometry3d board_somewhere(const CameraModel& camera, int side_px, const Chessboard& board, double farthest_rad,
                                  std::mt19937_64& random) {
  std::uniform_real_distribution<double> theta(0.0, farthest_rad), turn(-kPi, kPi), tilt(-0.6, 0.6), far(10.0, 22.0);
  for (;;) {
    const Direction towards{turn(random), kPi / 2.0 - theta(random)};
    Eigen::Isometry3d T_camera_board = Eigen::Isometry3d::Identity();
    const Eigen::Vector3d axis = ray(towards);
    T_camera_board.linear() = (Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis) *
                               Eigen::AngleAxisd(turn(random), Eigen::Vector3d::UnitZ()) *
                               Eigen::AngleAxisd(tilt(random), Eigen::Vector3d::UnitX()) *
                               Eigen::AngleAxisd(tilt(random), Eigen::Vector3d::UnitY()))
                                  .toRotationMatrix();
    T_camera_board.translation() = far(random) * board.square_m * axis;
    if (is_in_image(camera, side_px, board, T_camera_board)) return T_camera_board;
  }
}

Lens lens_185() {
  Lens lens;
  lens.axes = {{387.0, 379.0}, 1.0, 1, 0.5 * kPi};
  lens.radius_px = 0.5 * kSide_px;
  lens.c = {-0.620, 0.520, 0.015, 0.130};
  return lens;
}

CameraModel camera_185() {
  const Lens lens = lens_185();
  return {lens.axes, PolynomialFisheye(lens.coefficients(), 1.62)};
}

std::vector<Pixel> corners_of(const CameraModel& camera, const Chessboard& board,
                              const Eigen::Isometry3d& T_camera_board, double sigma_px, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, sigma_px);
  std::vector<Pixel> corners;
  for (std::size_t i = 0; i < board.corners(); ++i) {
    const Pixel at = *camera.pixel(Eigen::Vector3d(T_camera_board * board.corner(i)));
    const double off_u = noise(random), off_v = noise(random);
    corners.emplace_back(at + Pixel(off_u, off_v));
  }
  return corners;
}

}  // namespace azimuth::test
