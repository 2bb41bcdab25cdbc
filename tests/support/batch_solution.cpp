#include "tests/support/batch_solution.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace azimuth {

BatchProblem::BatchProblem(const BearingGraph& graph, const SmootherSettings& settings)
    : graph_(graph), settings_(settings), values_(graph.values()) {
  rows_ = 3 * (graph.poses() - 1);
  for (LandmarkId id = 0; id < graph.landmarks(); ++id) {
    landmark_row_.push_back(graph.bearings_of(id).empty() ? -1 : rows_);
    if (landmark_row_.back() >= 0) rows_ += graph.elevations_of(id) > 0 ? 3 : 2;
  }
  const CalibrationPriors& priors = settings.calibration;
  sigma_ = {priors.sigma_scale_distance, priors.sigma_scale_turn, priors.sigma_drift_rad_per_m,
            priors.sigma_lag_s,          priors.sigma_lag_growth, priors.sigma_camera_yaw_rad,
            priors.sigma_centre_px,      priors.sigma_centre_px};
  for (std::size_t i = 0; i < kCalibrations; ++i) calibration_row_[i] = sigma_[i] > 0.0 ? rows_++ : -1;
}

BatchProblem::Normal BatchProblem::normal() const {
  Normal normal;
  normal.gradient.setZero(rows_);
  std::vector<Eigen::Triplet<double>> triplets;
  // One non-zero derivative in a row of the Jacobian, divided by the standard deviation of the residual.
  struct Entry {
    Eigen::Index row;
    double value;
  };
  const auto add_row = [&](const std::vector<Entry>& row, double residual, double weight) {
    for (const Entry& a : row) {
      normal.gradient[a.row] += weight * a.value * residual;
      for (const Entry& b : row)
        if (a.row >= b.row) triplets.emplace_back(a.row, b.row, weight * a.value * b.value);
    }
  };
  for (PoseId id = 1; id < graph_.poses(); ++id) {
    const OdometryMeasurement& measured = graph_.odometry_to(id);
    const SeenMotion seen =
        see_motion(values_.poses[static_cast<std::size_t>(id) - 1], values_.poses[static_cast<std::size_t>(id)]);
    Eigen::Vector3d off =
        seen.relative - measured.relative - measured.by_calibration * values_.calibration.head<kOdometryCalibrations>();
    off.z() = wrap(off.z());
    const Eigen::Vector3d residual = measured.whitening * off;
    const Eigen::Matrix3d by_start = measured.whitening * seen.by_start, by_end = measured.whitening * seen.by_end;
    const Eigen::Matrix<double, 3, kOdometryCalibrations> by_calibration =
        -measured.whitening * measured.by_calibration;
    for (Eigen::Index i = 0; i < 3; ++i) {
      std::vector<Entry> row;
      for (Eigen::Index k = 0; k < 3; ++k) {
        if (id > 1) row.push_back({row_of_pose(id - 1) + k, by_start(i, k)});
        row.push_back({row_of_pose(id) + k, by_end(i, k)});
      }
      for (Eigen::Index k = 0; k < kOdometryCalibrations; ++k)
        if (calibration_row_[static_cast<std::size_t>(k)] >= 0)
          row.push_back({calibration_row_[static_cast<std::size_t>(k)], by_calibration(i, k)});
      add_row(row, residual[i], 1.0);
    }
    normal.energy += 0.5 * residual.squaredNorm();
  }
  for (BearingId id = 0; id < graph_.bearings(); ++id) {
    const LandmarkId landmark = graph_.landmark_of(id);
    const BearingMeasurement& measured = graph_.bearing(id);
    const Eigen::Vector2d mount = values_.calibration.segment<2>(calibration::camera_x);
    SeenAzimuth seen;
    if (landmark == kOfNothing ||
        !see(values_.poses[static_cast<std::size_t>(measured.pose)].moved({mount.x(), mount.y(), 0.0}),
             values_.landmarks[static_cast<std::size_t>(landmark)], settings_.min_distance_m, seen))
      continue;
    Eigen::Matrix<double, kCameraCalibrations, 1> by_camera;
    by_camera << -1.0, -measured.by_centre, seen.by_pose.head<2>();
    seen.by_pose.z() += seen.by_pose.y() * mount.x() - seen.by_pose.x() * mount.y();
    const double residual =
        wrap(seen.azimuth_rad - values_.calibration[calibration::yaw] -
             measured.by_centre.dot(values_.calibration.segment<2>(calibration::centre_x)) - measured.azimuth_rad) /
        measured.sigma_rad;
    const KernelValue kernel = kernel_value(settings_.kernel, settings_.kernel_width, residual * residual);
    std::vector<Entry> row;
    for (Eigen::Index k = 0; k < 3; ++k)
      if (measured.pose > 0) row.push_back({row_of_pose(measured.pose) + k, seen.by_pose[k] / measured.sigma_rad});
    for (Eigen::Index k = 0; k < 2; ++k)
      row.push_back({row_of_landmark(landmark) + k, seen.by_landmark[k] / measured.sigma_rad});
    for (Eigen::Index k = 0; k < kCameraCalibrations; ++k)
      if (const auto at = calibration_row_[static_cast<std::size_t>(kOdometryCalibrations + k)]; at >= 0)
        row.push_back({at, by_camera[k] / measured.sigma_rad});
    add_row(row, residual, kernel.weight);
    normal.energy += kernel.energy;
    if (!graph_.has_elevation(id)) continue;
    const MeasuredElevation& elevation = graph_.elevation(id);
    SeenElevation high;
    if (!see_height(values_.poses[static_cast<std::size_t>(measured.pose)],
                    values_.landmarks[static_cast<std::size_t>(landmark)],
                    values_.tangents[static_cast<std::size_t>(landmark)], settings_.min_distance_m, high))
      continue;
    const double off = (high.elevation_rad - elevation.elevation_rad) / elevation.sigma_rad;
    const KernelValue height_kernel = kernel_value(settings_.kernel, settings_.kernel_width, off * off);
    std::vector<Entry> second;
    for (Eigen::Index k = 0; k < 3; ++k)
      if (measured.pose > 0) second.push_back({row_of_pose(measured.pose) + k, high.by_pose[k] / elevation.sigma_rad});
    for (Eigen::Index k = 0; k < 2; ++k)
      second.push_back({row_of_landmark(landmark) + k, high.by_landmark[k] / elevation.sigma_rad});
    second.push_back({row_of_landmark(landmark) + 2, high.by_tangent / elevation.sigma_rad});
    add_row(second, off, height_kernel.weight);
    normal.energy += height_kernel.energy;
  }
  const auto add_prior = [&](Eigen::Index row, double off, double sigma) {
    add_row({{row, 1.0 / sigma}}, off / sigma, 1.0);
    normal.energy += 0.5 * off * off / (sigma * sigma);
  };
  for (LandmarkId id = 0; id < graph_.landmarks(); ++id)
    if (row_of_landmark(id) >= 0 && graph_.prior_information(id) > 0.0)
      add_prior(row_of_landmark(id) + 1,
                values_.landmarks[static_cast<std::size_t>(id)].inverse_distance_per_m - graph_.prior_mean_per_m(id),
                1.0 / std::sqrt(graph_.prior_information(id)));
  for (std::size_t i = 0; i < kCalibrations; ++i)
    if (calibration_row_[i] >= 0)
      add_prior(calibration_row_[i], values_.calibration[static_cast<Eigen::Index>(i)], sigma_[i]);
  normal.H.resize(rows_, rows_);
  normal.H.setFromTriplets(triplets.begin(), triplets.end());
  return normal;
}

void BatchProblem::move(const Eigen::VectorXd& step) {
  for (PoseId id = 1; id < graph_.poses(); ++id) {
    SmoothedPose& pose = values_.poses[static_cast<std::size_t>(id)];
    pose = pose.moved(step.segment<3>(row_of_pose(id)));
  }
  for (LandmarkId id = 0; id < graph_.landmarks(); ++id) {
    SmoothedLandmark& landmark = values_.landmarks[static_cast<std::size_t>(id)];
    if (row_of_landmark(id) >= 0) landmark = landmark.moved(step.segment<2>(row_of_landmark(id)));
    if (graph_.elevations_of(id) > 0) values_.tangents[static_cast<std::size_t>(id)] += step[row_of_landmark(id) + 2];
  }
  for (std::size_t i = 0; i < kCalibrations; ++i)
    if (calibration_row_[i] >= 0) values_.calibration[static_cast<Eigen::Index>(i)] += step[calibration_row_[i]];
}

int BatchProblem::solve(double tolerance, int most_steps) {
  Normal now = normal();
  double damping = 0.0;
  for (int steps = 1; steps <= most_steps; ++steps) {
    Eigen::SparseMatrix<double> H = now.H;
    for (Eigen::Index i = 0; i < rows_; ++i) H.coeffRef(i, i) *= 1.0 + damping;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(H);
    const Eigen::VectorXd step = factor.solve(-now.gradient);
    const BearingGraph::Values before = values_;
    move(step);
    Normal next = normal();
    if (next.energy > now.energy * (1.0 + 1e-11)) {
      values_ = before;
      damping = std::max(1e-10, 10.0 * damping);
      continue;
    }
    damping = damping < 1e-10 ? 0.0 : 0.1 * damping;
    now = std::move(next);
    if (damping == 0.0 && step.cwiseAbs().maxCoeff() < tolerance) return steps;
  }
  return -1;
}

double largest_difference(const BearingGraph::Values& a, const BearingGraph::Values& b) {
  double largest = (a.calibration - b.calibration).cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    const Eigen::Vector3d off = a.poses[i].T_map_body.vector() - b.poses[i].T_map_body.vector();
    largest = std::max({largest, std::abs(off.x()), std::abs(off.y()), std::abs(wrap(off.z()))});
  }
  for (std::size_t i = 0; i < a.landmarks.size(); ++i)
    largest = std::max({largest, std::abs(wrap(a.landmarks[i].direction_rad - b.landmarks[i].direction_rad)),
                        std::abs(a.landmarks[i].inverse_distance_per_m - b.landmarks[i].inverse_distance_per_m)});
  for (std::size_t i = 0; i < a.tangents.size(); ++i)
    if (!std::isnan(a.tangents[i])) largest = std::max(largest, std::abs(a.tangents[i] - b.tangents[i]));
  return largest;
}

}  // namespace azimuth
