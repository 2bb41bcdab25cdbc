#include "tools/drive_fit/tilt_calibration.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "slam/camera/make_camera.hpp"
#include "tools/drive_fit/calibration.hpp"
#include "tools/drive_fit/spread.hpp"

namespace azimuth {
namespace {

constexpr double kStep_rad = 0.01;       // step of the finite differences of the energy
constexpr double kToldTilt_rad = 0.005;  // largest standard deviation of a told tilt; a spirit level is as accurate
constexpr double kSurelyLeans = 18.4;    // chi squared with 2 degrees of freedom at a probability of 1e-4
constexpr double kAnyCentre_px = 10.0;
constexpr int kNewtonSteps = 3;

/// Energy of the drive as a function of the camera's tilt, with all other numbers fitted.
class EnergyOfTilt {
 public:
  EnergyOfTilt(const Drive& drive, const DriveSolution& solution, const CameraModel& camera,
               const HindsightSettings& settings)
      : drive_(drive), guess_(solution.guess), upright_(camera.upright()), settings_(settings), free_(free_heading()) {
    free_.sigma_centre_px = kAnyCentre_px;
  }

  double at(const DriveGraph& graph, const Eigen::Vector2d& by_rad) const {
    DriveGraph levelled = graph;
    for (DriveGraph::Place& place : levelled.places)
      for (DriveGraph::Seen& seen : place.seen)
        seen.bearing = relevelled(seen.bearing, upright_, {by_rad.x(), by_rad.y()});
    return solved(drive_, std::move(levelled), guess_, free_, settings_).energy;
  }

  Eigen::Vector2d slope(const DriveGraph& graph, const Eigen::Vector2d& by_rad) const {
    Eigen::Vector2d slope;
    for (const Eigen::Index axis : {0, 1}) {
      const Eigen::Vector2d step = kStep_rad * Eigen::Vector2d::Unit(axis);
      slope[axis] = (at(graph, by_rad + step) - at(graph, by_rad - step)) / (2.0 * kStep_rad);
    }
    return slope;
  }

  Eigen::Matrix2d curvature(const DriveGraph& graph, const Eigen::Vector2d& by_rad) const {
    const Eigen::Vector2d roll{kStep_rad, 0.0}, pitch{0.0, kStep_rad};
    const double here = at(graph, by_rad), both = at(graph, by_rad + roll + pitch) + at(graph, by_rad - roll - pitch);
    const double rolled = at(graph, by_rad + roll) + at(graph, by_rad - roll);
    const double pitched = at(graph, by_rad + pitch) + at(graph, by_rad - pitch);
    const double mixed = 0.5 * (both - rolled - pitched + 2.0 * here);
    return Eigen::Matrix2d{{rolled - 2.0 * here, mixed}, {mixed, pitched - 2.0 * here}} / (kStep_rad * kStep_rad);
  }

 private:
  const Drive& drive_;
  RigGuess guess_;
  CameraModel upright_;
  const HindsightSettings& settings_;
  FreeErrors free_;
};

/// Jackknife variance: each part of the drive is left out in turn.
Eigen::Vector2d variance_by_parts(const EnergyOfTilt& energy, const DriveGraph& graph, const Eigen::Vector2d& found_rad,
                                  const Eigen::LLT<Eigen::Matrix2d>& curvature) {
  std::vector<Eigen::Vector2d> off;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  std::size_t first = 0;
  for (const std::size_t end : ends_of_parts(graph)) {
    const DriveGraph rest = without(graph, std::exchange(first, end), end);
    off.push_back(curvature.solve(-energy.slope(rest, found_rad)));
    mean += off.back();
  }
  const auto parts = static_cast<double>(off.size());
  mean /= parts;
  Eigen::Vector2d variance = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& each : off) variance += (each - mean).cwiseAbs2() * (parts - 1.0) / parts;
  return variance;
}

}  // namespace

Bearing relevelled(const Bearing& bearing, const CameraModel& upright, const CameraTilt& by) {
  Bearing result = bearing;
  if (std::isnan(bearing.radius_px)) return result;
  const auto seen = upright.direction(upright.axes().pixel({bearing.radius_px, bearing.azimuth_rad}));
  if (seen) result.azimuth_rad = direction(Eigen::Vector3d(by.R_level_camera() * ray(*seen))).azimuth_rad;
  return result;
}

std::optional<TiltCalibration> calibrate_tilt(const Drive& drive, const DriveSolution& solution,
                                              const HindsightSettings& settings) {
  std::string ignored;
  const std::optional<CameraModel> camera = camera_of(solution.guess.rig.camera, ignored);
  if (!camera || !sees_images(solution.guess.rig)) return std::nullopt;
  const EnergyOfTilt energy(drive, solution, *camera, settings);
  TiltCalibration found{.tilt = camera->tilt()};
  Eigen::Vector2d by_rad = Eigen::Vector2d::Zero();
  Eigen::LLT<Eigen::Matrix2d> curvature;
  for (int i = 0; i < kNewtonSteps; ++i) {
    curvature.compute(energy.curvature(solution.graph, by_rad));
    if (curvature.info() != Eigen::Success) return found;
    by_rad -= curvature.solve(energy.slope(solution.graph, by_rad)).cwiseMax(-0.1).cwiseMin(0.1);
  }
  // The larger of two variances, as in spread_of().
  const Eigen::Vector2d by_parts = variance_by_parts(energy, solution.graph, by_rad, curvature);
  const Eigen::Matrix2d by_graph = curvature.solve(Eigen::Matrix2d::Identity());
  const Eigen::Vector2d variance = by_parts.cwiseMax(by_graph.diagonal());
  found.sigma_rad = std::sqrt(variance.maxCoeff());
  found.told = found.sigma_rad <= kToldTilt_rad;
  found.contradicts = found.told && (by_rad.array().square() / variance.array()).sum() > kSurelyLeans;
  const CameraTilt by{by_rad.x(), by_rad.y()};
  found.likeliest = tilt_of_axis(by.R_level_camera() * camera->tilt().R_level_camera() * Eigen::Vector3d::UnitZ());
  if (found.contradicts) found.tilt = found.likeliest;
  return found;
}

}  // namespace azimuth
