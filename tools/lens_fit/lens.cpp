#include "tools/lens_fit/lens.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/camera/make_camera.hpp"

namespace azimuth {
namespace {

constexpr std::array<int, 4> kPowers{0, 2, 3, 4};
constexpr double kNoDistance = 1e-9;

double polynomial(const std::array<double, 4>& c, double rho) {
  return c[0] + rho * rho * (c[1] + rho * (c[2] + rho * c[3]));
}
double slope(const std::array<double, 4>& c, double rho) {
  return rho * (2.0 * c[1] + rho * (3.0 * c[2] + rho * 4.0 * c[3]));
}

/// Newton's method on rho Z + F(rho) d = 0, whose slope Z + F' d is positive where theta grows with the radius.
std::optional<double> rho_of(const std::array<double, 4>& c, double beside, double above, double rho) {
  constexpr double kFarthest = 3.0;
  for (int i = 0; i < 30; ++i) {
    const double along = above + slope(c, rho) * beside;
    if (!(along > 0.0)) return std::nullopt;
    const double step = -(rho * above + polynomial(c, rho) * beside) / along;
    rho = std::clamp(rho + step, 0.0, kFarthest);
    if (std::abs(step) < 1e-13) return rho < kFarthest ? std::optional(rho) : std::nullopt;
  }
  return std::nullopt;
}

/// The image, along the u axis, of a direction `theta_rad` from the lens axis.
std::optional<Lens::Image> image_along_u(Lens lens, double theta_rad) {
  lens.tilt = {};
  const double azimuth = lens.axes.azimuth_offset_rad;
  const Eigen::Vector3d towards{std::sin(theta_rad) * std::cos(azimuth), std::sin(theta_rad) * std::sin(azimuth),
                                std::cos(theta_rad)};
  return lens.image(towards, lens.radius_px * theta_rad / 1.6);
}

}  // namespace

/* With azimuth offset o and azimuth direction s, q = (X cos o + Y sin o, s (Y cos o - X sin o)) is d times the unit
 * direction in the image. Hence (u, v) = (u0, beta v0) + diag(1, beta) (r / d) q, which is smooth at the centre.
 */
std::optional<Lens::Image> Lens::image_in_camera(const Eigen::Vector3d& point_m, double about_px) const {
  const double beside = std::max(point_m.head<2>().norm(), kNoDistance), above = point_m.z();
  const auto rho = rho_of(c, beside, above, about_px / radius_px);
  if (!rho) return std::nullopt;
  const double cos = std::cos(axes.azimuth_offset_rad), sin = std::sin(axes.azimuth_offset_rad);
  const double hand = axes.azimuth_direction;
  const Eigen::Matrix2d turn{{cos, sin}, {-hand * sin, hand * cos}}, by_offset{{-sin, cos}, {-hand * cos, -hand * sin}};
  const Eigen::Vector2d q = turn * point_m.head<2>(), stretch{1.0, axes.beta};
  const double zoom = radius_px * *rho / beside, along = above + slope(c, *rho) * beside;
  const auto by_rho = Eigen::Vector2d(stretch.cwiseProduct(q) * (radius_px / beside));

  Image image;
  image.pixel = stretch.cwiseProduct(axes.centre_px + zoom * q);
  const double rho_by_beside = -polynomial(c, *rho) / along, rho_by_above = -*rho / along;
  image.by_point.leftCols<2>() = stretch.asDiagonal() * (zoom * turn) +
                                 (by_rho * (rho_by_beside - *rho / beside)) * (point_m.head<2>() / beside).transpose();
  image.by_point.col(2) = by_rho * rho_by_above;
  image.by_lens.leftCols<2>() = stretch.asDiagonal();
  for (int k = 0; k < 4; ++k)
    image.by_lens.col(2 + k) = by_rho * (-std::pow(*rho, kPowers[static_cast<std::size_t>(k)]) * beside / along);
  image.by_lens.col(6) = stretch.cwiseProduct(zoom * (by_offset * point_m.head<2>()));
  return image;
}

/* In the camera's frame q = R_x(-roll) R_y(-pitch) p, so that d q / d roll = -e_x x q and
 * d q / d pitch = -R_x(-roll) (e_y x R_y(-pitch) p) = -(R^T e_y) x q (mathematics VI.34).
 */
std::optional<Lens::Image> Lens::image(const Eigen::Vector3d& point_m, double about_px) const {
  const Eigen::Matrix3d R_camera_level = tilt.R_level_camera().transpose();
  const Eigen::Vector3d in_camera = tilt.is_level() ? point_m : Eigen::Vector3d(R_camera_level * point_m);
  auto image = image_in_camera(in_camera, about_px);
  if (!image) return image;
  image->by_tilt.col(0) = -image->by_point * Eigen::Vector3d::UnitX().cross(in_camera);
  image->by_tilt.col(1) = -image->by_point * R_camera_level.col(1).cross(in_camera);
  if (!tilt.is_level()) image->by_point = image->by_point * R_camera_level;
  return image;
}

std::optional<Eigen::Vector2d> Lens::on_plane(const Pixel& pixel, double height_m) const {
  const Eigen::Vector3d towards = ray(pixel);
  if (!(towards.z() > 1e-3)) return std::nullopt;
  return height_m / towards.z() * towards.head<2>();
}

Eigen::Vector3d Lens::ray(const Pixel& pixel) const {
  const PolarPixel polar = axes.polar(pixel);
  const double rho = polar.radius_px / radius_px;
  const Eigen::Vector3d in_camera{rho * std::cos(polar.azimuth_rad), rho * std::sin(polar.azimuth_rad),
                                  -polynomial(c, rho)};
  return tilt.is_level() ? in_camera : Eigen::Vector3d(tilt.R_level_camera() * in_camera);
}

double Lens::theta_rad(double at_px) const {
  const double rho = at_px / radius_px;
  return std::atan2(rho, -polynomial(c, rho));
}

LensVector Lens::numbers() const {
  LensVector all;
  all << axes.centre_px, c[0], c[1], c[2], c[3], axes.azimuth_offset_rad;
  return all;
}

Lens Lens::moved(const LensVector& by) const {
  Lens lens = *this;
  lens.axes.centre_px += by.head<2>();
  for (int k = 0; k < 4; ++k) lens.c[static_cast<std::size_t>(k)] += by[2 + k];
  lens.axes.azimuth_offset_rad = wrap(lens.axes.azimuth_offset_rad + by[6]);
  return lens;
}

std::array<double, PolynomialFisheye::kCoefficients> Lens::coefficients() const {
  std::array<double, PolynomialFisheye::kCoefficients> a{};
  for (std::size_t k = 0; k < 4; ++k)
    a[static_cast<std::size_t>(kPowers[k])] = c[k] * std::pow(radius_px, 1 - kPowers[k]);
  return a;
}

/// Minimises the sum of squares of rho cos(theta) + F(rho) sin(theta) over radii, which is linear in the coefficients.
std::optional<Lens> lens_of(const CameraRig& rig, double unit_px, std::string& problem) {
  const auto tilted = camera_of(rig, problem);
  if (!tilted) return std::nullopt;
  const CameraModel camera = tilted->upright();
  Lens lens{.axes = camera.axes(), .c = {}, .radius_px = unit_px, .tilt = tilted->tilt()};
  std::vector<Eigen::Vector2d> seen;  // rho, theta
  constexpr int kRadii = 400;
  for (int i = 1; i <= kRadii; ++i) {
    const double rho = static_cast<double>(i) / kRadii;
    const Pixel pixel{lens.axes.centre_px.x() + rho * unit_px, lens.axes.beta * lens.axes.centre_px.y()};
    if (const auto direction = camera.direction(pixel)) seen.emplace_back(rho, kPi / 2.0 - direction->elevation_rad);
  }
  if (seen.size() < 10) {
    problem = "its theta_max_rad leaves too little of the image to begin from";
    return std::nullopt;
  }
  Eigen::MatrixXd rows(seen.size(), 4);
  Eigen::VectorXd right(seen.size());
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const double rho = seen[as_size(i)].x(), theta = seen[as_size(i)].y();
    for (int k = 0; k < 4; ++k) rows(i, k) = std::sin(theta) * std::pow(rho, kPowers[as_size(k)]);
    right[i] = -rho * std::cos(theta);
  }
  const Eigen::Vector4d fitted = rows.colPivHouseholderQr().solve(right);
  for (int k = 0; k < 4; ++k) lens.c[as_size(k)] = fitted[k];
  return lens;
}

double radius_px(const Lens& lens, double theta_rad) {
  const auto image = image_along_u(lens, theta_rad);
  return image ? image->pixel.x() - lens.axes.centre_px.x() : kNotSet;
}

double sigma_radius_px(const Lens& lens, const LensCovariance& covariance, double theta_rad) {
  const auto image = image_along_u(lens, theta_rad);
  if (!image) return kNotSet;
  const Eigen::Vector4d by_shape = image->by_lens.block<1, 4>(0, 2).transpose();
  return std::sqrt(by_shape.dot(covariance.block<4, 4>(2, 2) * by_shape));
}

double theta_max_rad(const Lens& lens, double wanted_rad) {
  constexpr double kLeast_rad = 0.3, kStep_rad = 0.02;
  for (double theta_rad = wanted_rad; theta_rad > kLeast_rad; theta_rad -= kStep_rad)
    if (!PolynomialFisheye(lens.coefficients(), theta_rad).problem()) return theta_rad;
  return kLeast_rad;
}

double image_radius_px(const ImageRig& image) {
  const double side_px = std::min(image.width_px.value_or(0), image.height_px.value_or(0));
  return std::min(0.5 * side_px, image.mask_outer_px.value_or(0.5 * side_px));
}

CameraRig with_lens(CameraRig rig, const Lens& lens, double theta_max_rad) {
  rig.model = PolynomialRig{lens.coefficients()};
  rig.image.centre_px = {lens.axes.centre_px.x(), lens.axes.centre_px.y()};
  rig.image.azimuth_offset_rad = lens.axes.azimuth_offset_rad;
  rig.image.theta_max_rad = theta_max_rad;
  rig.roll_rad = lens.tilt.roll_rad;
  rig.pitch_rad = lens.tilt.pitch_rad;
  return rig;
}

}  // namespace azimuth
