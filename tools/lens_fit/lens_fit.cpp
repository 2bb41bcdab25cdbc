#include "tools/lens_fit/lens_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace azimuth {
namespace {

constexpr double kSame = 1e-6;     // standard deviation of fixed numbers, in their own units
constexpr double kLeast_m = 1e-4;  // least standard deviation of a motion [m, rad]: odometry may state zero

/// (x, y, heading) of the end pose relative to the start pose, and its derivatives.
struct RelativePose {
  Eigen::Vector3d value;
  Eigen::Matrix3d by_start, by_end;
};

/* With D = R(phi_s)^T (p_e - p_s):  d D / d phi_s = (D_y, -D_x) */
RelativePose relative_pose(const Pose2& T_map_start, const Pose2& T_map_end) {
  RelativePose relative;
  relative.value = (inverse(T_map_start) * T_map_end).vector();
  const double cos = std::cos(T_map_start.heading_rad), sin = std::sin(T_map_start.heading_rad);
  const Eigen::Matrix2d turn{{cos, sin}, {-sin, cos}};
  relative.by_end = Eigen::Matrix3d::Identity();
  relative.by_end.topLeftCorner<2, 2>() = turn;
  relative.by_start = -relative.by_end;
  relative.by_start.col(2) << relative.value.y(), -relative.value.x(), -1.0;
  return relative;
}

class Equations {
 public:
  Equations(const LensDrive& drive, const LensSolution& at, const LensSolution& start, const LensPriors& priors)
      : drive_(drive), at_(at), start_(start), priors_(priors) {}

  LensEquations all() {
    know_beforehand();
    for (std::size_t i = 1; i < drive_.motions.size(); ++i) drive_on(i);
    for (std::size_t i = 0; i < at_.lamps.size(); ++i)
      row({{height_of(i), 1.0 / priors_.sigma_one_lamp_m}}, at_.lamps[i].z() / priors_.sigma_one_lamp_m);
    for (const LampObservation& sighting : drive_.sightings) see(sighting);
    out_.J.resize(static_cast<Eigen::Index>(errors_.size()), of_lamp(at_.lamps.size()));
    out_.J.setFromTriplets(entries_.begin(), entries_.end());
    out_.e = Eigen::Map<const Eigen::VectorXd>(errors_.data(), as_index(errors_.size()));
    return std::move(out_);
  }

 private:
  struct Entry {
    int column;
    double value;
  };
  static int of_frame(std::size_t frame) { return kThroughout + 3 * static_cast<int>(frame); }
  int of_lamp(std::size_t lamp) const { return of_frame(at_.T_map_body.size()) + 3 * static_cast<int>(lamp); }
  int height_of(std::size_t lamp) const { return of_lamp(lamp) + 2; }

  /// Adds one row and its cost. Observation rows are added without row(), since their cost uses the robust kernel.
  void row(std::initializer_list<Entry> entries, double error) {
    for (const Entry& entry : entries)
      entries_.emplace_back(static_cast<int>(errors_.size()), entry.column, entry.value);
    errors_.push_back(error);
    out_.cost += 0.5 * error * error;
  }
  template <class Matrix>
  void put(int column, const Matrix& block) {
    for (int i = 0; i < block.rows(); ++i)
      for (int k = 0; k < block.cols(); ++k)
        entries_.emplace_back(static_cast<int>(errors_.size()) + i, column + k, block(i, k));
  }

  void know_beforehand() {
    if (priors_.lamp_height_m) {
      row({{kLampHeight, 1.0 / priors_.sigma_lamp_height_m}},
          (at_.lamp_height_m - *priors_.lamp_height_m) / priors_.sigma_lamp_height_m);
    } else {
      row({{2, 1.0 / kSame}}, (at_.lens.c[0] - start_.lens.c[0]) / kSame);
    }
    row({{kScaleDistance, 1.0 / priors_.sigma_scale_distance}},
        at_.scale_distance_error / priors_.sigma_scale_distance);
    row({{kScaleTurn, 1.0 / priors_.sigma_scale_turn}}, at_.scale_turn_error / priors_.sigma_scale_turn);
    const double sigma_tilt_rad = std::max(priors_.sigma_tilt_rad, kSame);
    row({{kRoll, 1.0 / sigma_tilt_rad}}, (at_.lens.tilt.roll_rad - priors_.tilt.roll_rad) / sigma_tilt_rad);
    row({{kPitch, 1.0 / sigma_tilt_rad}}, (at_.lens.tilt.pitch_rad - priors_.tilt.pitch_rad) / sigma_tilt_rad);
    const Pose2& first = at_.T_map_body.front();  // the origin of the map
    row({{of_frame(0), 1.0 / kSame}}, first.x_m / kSame);
    row({{of_frame(0) + 1, 1.0 / kSame}}, first.y_m / kSame);
    row({{of_frame(0) + 2, 1.0 / kSame}}, first.heading_rad / kSame);
  }

  /* Residual of a measured motion z, given the estimated motion q = (X, Y, P) and the scale errors s_d and s_t:
   *
   *   e = q - z - s_d (X, Y, 0) - s_t P (-Y / 2, X / 2, 1)
   *
   * The scale errors multiply the estimated motion, not the measured one. Otherwise the noise would shrink with the
   * scale, and the fit would favour a world that is too small (mathematics VI.28). The chord of an arc turns by half
   * the turn of the arc.
   */
  void drive_on(std::size_t frame) {
    const Motion& motion = drive_.motions[frame];
    const RelativePose relative = relative_pose(at_.T_map_body[frame - 1], at_.T_map_body[frame]);
    const double x = relative.value.x(), y = relative.value.y(), turn = relative.value.z();
    const double by_distance = at_.scale_distance_error, by_turn = at_.scale_turn_error;
    const Eigen::Matrix3d covariance = motion.covariance + kLeast_m * kLeast_m * Eigen::Matrix3d::Identity();
    const Eigen::LLT<Eigen::Matrix3d> root(covariance);
    ByScales by_scales;
    by_scales << x, -0.5 * turn * y, y, 0.5 * turn * x, 0.0, turn;
    const Eigen::Matrix3d by_relative{
        {1.0 - by_distance, 0.5 * by_turn * turn, 0.5 * by_turn * y},
        {-0.5 * by_turn * turn, 1.0 - by_distance, -0.5 * by_turn * x},
        {0.0, 0.0, 1.0 - by_turn},
    };
    Eigen::Vector3d error =
        relative.value - motion.T_start_end.vector() - by_scales * Eigen::Vector2d(by_distance, by_turn);
    error.z() = wrap(error.z());
    put(of_frame(frame - 1), Eigen::Matrix3d(root.matrixL().solve(by_relative * relative.by_start)));
    put(of_frame(frame), Eigen::Matrix3d(root.matrixL().solve(by_relative * relative.by_end)));
    put(kScaleDistance, ByScales(root.matrixL().solve(-by_scales)));
    for (const double each : Eigen::Vector3d(root.matrixL().solve(error))) row({}, each);
  }

  /* A lamp at l with height H + h, seen by a robot at p with heading phi, has the coordinates
   *   (X, Y) = R(phi)^T (l - p), Z = H + h;   d (X, Y) / d phi = (Y, -X)
   */
  void see(const LampObservation& sighting) {
    const Pose2& pose = at_.T_map_body[sighting.frame];
    const Eigen::Vector3d& lamp = at_.lamps[sighting.lamp];
    Eigen::Vector3d point;
    point << inverse(pose) * Eigen::Vector2d(lamp.head<2>()), at_.lamp_height_m + lamp.z();
    const auto image = at_.lens.image(point, at_.lens.axes.polar(sighting.pixel).radius_px);
    if (!image || !(point.z() > 0.0)) return lose();
    const Eigen::LLT<Eigen::Matrix2d> root(sighting.covariance_px2);
    const Eigen::Vector2d off_px = image->pixel - sighting.pixel;
    const Eigen::Vector2d error = root.matrixL().solve(off_px);
    const double weight = cauchy_weight(error.squaredNorm());
    const Eigen::Matrix2d whitening =
        std::sqrt(weight) * Eigen::Matrix2d(root.matrixL().solve(Eigen::Matrix2d::Identity()));
    const double cos = std::cos(pose.heading_rad), sin = std::sin(pose.heading_rad);
    const Eigen::Matrix2d turn{{cos, sin}, {-sin, cos}};
    Eigen::Matrix3d by_pose = Eigen::Matrix3d::Zero(), by_lamp = Eigen::Matrix3d::Identity();
    by_pose.topLeftCorner<2, 2>() = -turn;
    by_pose.col(2) << point.y(), -point.x(), 0.0;
    by_lamp.topLeftCorner<2, 2>() = turn;
    const Eigen::Matrix<double, 2, 3> by_point = whitening * image->by_point;
    put(0, Eigen::Matrix<double, 2, kLensNumbers>(whitening * image->by_lens));
    put(kLampHeight, Eigen::Vector2d(by_point.col(2)));
    put(kRoll, Eigen::Matrix2d(whitening * image->by_tilt));
    put(of_frame(sighting.frame), Eigen::Matrix<double, 2, 3>(by_point * by_pose));
    put(of_lamp(sighting.lamp), Eigen::Matrix<double, 2, 3>(by_point * by_lamp));
    for (const double each : error) errors_.push_back(std::sqrt(weight) * each);
    out_.cost += cauchy_cost(error.squaredNorm());
    out_.mahalanobis2.push_back(error.squaredNorm());
    out_.error_px.push_back(off_px.norm());
  }
  void lose() {
    out_.cost += lost_cost();
    out_.mahalanobis2.push_back(std::numeric_limits<double>::infinity());
    out_.error_px.push_back(std::numeric_limits<double>::quiet_NaN());
  }

  const LensDrive& drive_;
  const LensSolution &at_, &start_;
  const LensPriors& priors_;
  LensEquations out_;
  std::vector<Eigen::Triplet<double>> entries_;
  std::vector<double> errors_;
};

}  // namespace

LensEquations lens_equations(const LensDrive& drive, const LensSolution& at, const LensSolution& start,
                             const LensPriors& priors) {
  return Equations(drive, at, start, priors).all();
}

LensSolution lens_moved(LensSolution from, const Eigen::VectorXd& by) {
  from.lens = from.lens.moved(by.head<kLensNumbers>());
  from.lamp_height_m += by[kLampHeight];
  from.scale_distance_error += by[kScaleDistance];
  from.scale_turn_error += by[kScaleTurn];
  from.lens.tilt.roll_rad += by[kRoll];
  from.lens.tilt.pitch_rad += by[kPitch];
  Eigen::Index next = kThroughout;
  for (Pose2& pose : from.T_map_body) {
    pose = {pose.x_m + by[next], pose.y_m + by[next + 1], wrap(pose.heading_rad + by[next + 2])};
    next += 3;
  }
  for (Eigen::Vector3d& lamp : from.lamps) {
    lamp += by.segment<3>(next);
    next += 3;
  }
  return from;
}

double LensSolution::rms_px() const { return azimuth::rms_px(error_px, fits); }

double LensSolution::fitting() const { return share(fits); }

std::optional<LensSolution> fit_lens(const LensDrive& drive, const LensSolution& start, const LensPriors& priors) {
  auto found = settled(
      start, [&](const LensSolution& at) { return lens_equations(drive, at, start, priors); }, lens_moved);
  if (!found) return std::nullopt;
  const auto covariance = leading_covariance(found->equations, kThroughout);
  if (!covariance) return std::nullopt;
  LensSolution& solution = found->at;
  const double unknowns = 3.0 * static_cast<double>(solution.lamps.size()) + kLensNumbers;
  SightingWeights weights = weigh(found->equations.mahalanobis2, unknowns);
  solution.error_px = std::move(found->equations.error_px);
  solution.fits = std::move(weights.fits);
  solution.unit_variance = std::max(1.0, weights.unit_variance);
  solution.covariance = solution.unit_variance * *covariance;
  return std::move(solution);
}

}  // namespace azimuth
