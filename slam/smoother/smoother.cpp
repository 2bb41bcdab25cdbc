#include "slam/smoother/smoother.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace azimuth {
namespace {

constexpr double kFirstDamping = 1e-10, kMostDamping = 1e8;
constexpr double kMoreDamping = 10.0, kLessDamping = 5.0;
constexpr int kTriesForEachIteration = 3;
// Relative rounding error of an energy, which is a sum of thousands of terms.
constexpr double kEnergyRounding = 1e-11;
// A step whose promised gain is below this multiple of converged_below, and which fails to lower the energy, is not
// worth damping: damping factorises everything anew.
constexpr double kLittle = 100.0;
constexpr int kTimesHalved = 2;
// Fractions of sqrt(converged_below). Unknowns with a smaller pull (in standard deviations) or a smaller step (in
// metres, radians or 1/m) stay as they are.
constexpr double kNegligiblePull = 1e-5, kNegligibleStep = 3e-6;

constexpr int kProbes = 4;
constexpr double kFewestTold = 8.0;  // least redundancy for an estimate
constexpr double kLeast = 0.1, kMost = 10.0;
constexpr double kLeastShareTold = 1e-9;  // of the curvature; less is rounding

/// Expected weighted squared residual of standard Gaussian noise within the scatter bound. It is below one, since the
/// kernel also reduces the weight of a Gaussian's tails.
double expected_chi2(RobustKernel kernel, double width) {
  constexpr double kStep = 0.01;
  const double end = std::sqrt(kScattersChi2);
  double sum = 0.0, whole = 0.0;
  for (double r = 0.5 * kStep; r < end; r += kStep) {
    const double density = std::exp(-0.5 * r * r);
    whole += density;
    sum += density * kernel_value(kernel, width, r * r).weight * r * r;
  }
  return sum / whole;
}

Smoother::Noise noise_by(double chi2, double told) {
  if (!(told > kFewestTold)) return {};
  return {.ratio = std::clamp(std::sqrt(chi2 / told), kLeast, kMost), .told = told};
}

}  // namespace

Smoother::Smoother(const SmootherSettings& settings, const Pose2& T_map_first)
    : settings_(settings), graph_(settings, T_map_first) {
  factor_.restructure(BearingGraph::kCalibrationBlock);
}

PoseId Smoother::add_pose(const Motion& motion, const ByLag& by_lag) {
  const PoseId id = graph_.add_pose(motion, by_lag);
  factor_.restructure(graph_.block_of_pose(id));
  // The term of the new pose and the calibration is tied in through the pose before. The first pose is no unknown.
  factor_.restructure(id > 1 ? graph_.block_of_pose(id - 1) : BearingGraph::kCalibrationBlock);
  return id;
}

LandmarkId Smoother::add_landmark(BearingId first) {
  const LandmarkId id = graph_.add_landmark(first);
  assign(first, id);
  return id;
}

void Smoother::assign(BearingId bearing, LandmarkId landmark) {
  const LandmarkId before = graph_.landmark_of(bearing);
  if (before == landmark) return;
  const Block pose = graph_.block_of_pose(graph_.bearing(bearing).pose);
  if (before != kOfNothing) {
    const Block block = graph_.block_of_landmark(before);
    factor_.mark_stale(pose, block);
    untie_height(bearing);
    if (graph_.bearings_of(before).size() == 1 && !graph_.is_known(before)) factor_.remove(block);
  }
  graph_.assign(bearing, landmark);
  if (landmark == kOfNothing) return;
  tie_height(bearing);
  const Block block = graph_.block_of_landmark(landmark);
  if (graph_.bearings_of(landmark).size() == 1) factor_.restructure(block);
  if (graph_.size(pose) == 0) {  // a constant pose: the term is between landmark and calibration
    factor_.restructure(BearingGraph::kCalibrationBlock);
    return factor_.restructure(block);
  }
  if (factor_.couples(pose, block)) return;
  factor_.restructure(pose);
  factor_.restructure(block);
}

/// The term involves pose, landmark and height, and lies in the front of whichever is eliminated first.
void Smoother::untie_height(BearingId bearing) {
  if (!graph_.has_elevation(bearing)) return;
  const LandmarkId landmark = graph_.landmark_of(bearing);
  const Block height = graph_.block_of_height(landmark);
  factor_.mark_stale(graph_.block_of_pose(graph_.bearing(bearing).pose), height);
  factor_.mark_stale(graph_.block_of_landmark(landmark), height);
  if (graph_.elevations_of(landmark) == 1) factor_.remove(height);
}

void Smoother::tie_height(BearingId bearing) {
  if (!graph_.has_elevation(bearing)) return;
  const LandmarkId landmark = graph_.landmark_of(bearing);
  const Block pose = graph_.block_of_pose(graph_.bearing(bearing).pose), height = graph_.block_of_height(landmark),
              block = graph_.block_of_landmark(landmark);
  if (graph_.elevations_of(landmark) == 1 || !factor_.couples(block, height)) {
    factor_.restructure(height);
    factor_.restructure(block);
  }
  if (graph_.size(pose) == 0 || factor_.couples(pose, height)) return;
  factor_.restructure(pose);
  factor_.restructure(height);
}

void Smoother::remember(Remembered remembered) {
  graph_.remember(std::move(remembered));
  const Remembered& known = graph_.remembered();
  if (known.pose > 0) factor_.restructure(graph_.block_of_pose(known.pose));
  for (const LandmarkId id : known.landmarks) factor_.restructure(graph_.block_of_landmark(id));
}

void Smoother::merge(LandmarkId kept, LandmarkId gone) {
  const std::vector<BearingId> bearings = graph_.bearings_of(gone);
  for (const BearingId bearing : bearings) assign(bearing, kept);
}

void Smoother::use_prior(LandmarkId landmark, bool used) {
  if (graph_.has_prior(landmark) == used) return;
  graph_.use_prior(landmark, used);
  const Block block = graph_.block_of_landmark(landmark);
  factor_.mark_stale(block, block);
}

/// The factor is rebuilt: most fronts depend on removed blocks, and the blocks are renumbered.
void Smoother::forget(std::span<const PoseId> poses) {
  graph_.forget(poses);
  start_factor_anew();
}

void Smoother::begin_at(const BearingGraph::Values& values) {
  graph_.begin_at(values);
  start_factor_anew();
}

void Smoother::mark_stale_terms() {
  for (const auto& [a, b] : graph_.take_stale()) factor_.mark_stale(a, b);
}

void Smoother::start_factor_anew() {
  factor_ = FrontTree();
  for (Block block = 0; block < graph_.blocks(); ++block) factor_.restructure(block);
}

/// Gauss-Newton with the exact gradient and a factor that may be slightly out of date. The gradient is zero at the
/// solution all the same.
Smoother::Outcome Smoother::optimise(int max_iterations) {
  Outcome outcome;
  const double deviation = std::sqrt(settings_.converged_below);
  int tries = kTriesForEachIteration * max_iterations;
  graph_.evaluate();
  while (outcome.iterations < max_iterations) {
    mark_stale_terms();
    const double energy = graph_.energy();
    const bool positive = factor_.update(graph_);
    if (positive) {
      Eigen::VectorXd step = -graph_.gradient();
      factor_.forwards(step, kNegligiblePull * deviation);
      if (0.5 * step.squaredNorm() < settings_.converged_below) {  // half of g^T H^-1 g
        outcome.converged = true;
        return outcome;
      }
      const double promised = 0.5 * step.squaredNorm();
      factor_.backwards(step, kNegligibleStep * deviation);
      ++outcome.iterations;
      if (take_step(step, energy)) continue;
      if (promised < kLittle * settings_.converged_below) {
        if (!take_shorter_step(step, energy)) break;
        continue;
      }
    } else {
      ++outcome.iterations;
    }
    ++outcome.damped;
    if (!take_damped_step(energy, tries)) break;
  }
  if (max_iterations == 0) {
    mark_stale_terms();
    factor_.update(graph_);
  }
  return outcome;
}

/// Returns false and restores all unknowns when the energy does not fall.
bool Smoother::take_step(const Eigen::VectorXd& step, double energy_before) {
  const BearingGraph::Moved moved = graph_.move(step, kNegligibleStep * std::sqrt(settings_.converged_below));
  graph_.evaluate();
  if (graph_.energy() <= energy_before * (1.0 + kEnergyRounding)) return true;
  graph_.move_back(moved);
  graph_.evaluate();
  return false;
}

/// Tries the step halved once and twice. A single landmark with few bearings can spoil a full step.
bool Smoother::take_shorter_step(const Eigen::VectorXd& step, double energy_before) {
  double length = 1.0;
  for (int i = 0; i < kTimesHalved; ++i)
    if (take_step((length *= 0.5) * step, energy_before)) return true;
  return false;
}

/// Raises the damping until the energy falls. When the tries are used up, the next image continues with the same
/// damping, so that contradictory measurements cannot delay an image.
bool Smoother::take_damped_step(double energy_before, int& tries) {
  damping_ = std::max(kFirstDamping, damping_ / kLessDamping);
  for (; damping_ <= kMostDamping; damping_ *= kMoreDamping) {
    if (tries-- <= 0) return false;
    FrontTree damped = factor_;
    damped.mark_all_stale();
    if (!damped.update(graph_, damping_)) continue;
    Eigen::VectorXd step = -graph_.gradient();
    damped.solve(step);
    if (take_step(step, energy_before)) return true;
  }
  damping_ = 0.0;
  return false;
}

// Covariances of poses, landmarks and calibration, computed from the factor.

/// The factor's unknowns of a pose are along the body's axes; R(heading) turns them into the map's axes.
Eigen::MatrixXd Smoother::covariance(std::span<const Unknown> unknowns) const {
  std::vector<Block> blocks;
  Eigen::Index rows = 0;
  for (const Unknown& unknown : unknowns) {
    const auto* const pose = std::get_if<PoseOf>(&unknown);
    blocks.push_back(pose != nullptr ? graph_.block_of_pose(pose->id)
                                     : graph_.block_of_landmark(std::get<LandmarkOf>(unknown).id));
    rows += graph_.size(blocks.back());
  }
  Eigen::MatrixXd to_map = Eigen::MatrixXd::Identity(rows, rows);
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (const auto* const pose = std::get_if<PoseOf>(&unknowns[i]); pose != nullptr && graph_.size(blocks[i]) > 0)
      to_map.block<2, 2>(row, row) = rotation(graph_.pose(pose->id).heading_rad);
    row += graph_.size(blocks[i]);
  }
  return to_map * factor_.covariance(blocks, graph_) * to_map.transpose();
}

Eigen::Matrix3d Smoother::pose_covariance(PoseId id) const {
  if (graph_.size(graph_.block_of_pose(id)) == 0) return Eigen::Matrix3d::Zero();
  const Unknown pose = PoseOf{id};
  return covariance({&pose, 1});
}

Eigen::Matrix<double, kCalibrations, kCalibrations> Smoother::calibration_covariance() const {
  Eigen::Matrix<double, kCalibrations, kCalibrations> whole =
      Eigen::Matrix<double, kCalibrations, kCalibrations>::Zero();
  constexpr Block kBlock = BearingGraph::kCalibrationBlock;
  if (graph_.size(kBlock) == 0) return whole;
  const Eigen::MatrixXd unknown = factor_.covariance({&kBlock, 1}, graph_);
  for (int i = 0; i < kCalibrations; ++i)
    for (int j = 0; j < kCalibrations; ++j)
      if (const int a = graph_.calibration_row(i), b = graph_.calibration_row(j); a >= 0 && b >= 0)
        whole(i, j) = unknown(a, b);  // the block's rows are the first ones
  return whole;
}

Eigen::Matrix2d Smoother::point_covariance(LandmarkId id) const {
  const Unknown landmark = LandmarkOf{id};
  const Eigen::Matrix2d by_chart = graph_.landmark(id).p_by_chart();
  return by_chart * covariance({&landmark, 1}) * by_chart.transpose();
}

/// The graph estimates tangent = height * rho, where rho is the inverse distance; hence height = tangent / rho.
Eigen::Matrix3d Smoother::point_covariance_with_height(LandmarkId id) const {
  const std::vector<Block> blocks{graph_.block_of_landmark(id), graph_.block_of_height(id)};
  const double rho_per_m = graph_.landmark(id).inverse_distance_per_m;
  Eigen::Matrix3d to_point = Eigen::Matrix3d::Zero();
  to_point.topLeftCorner<2, 2>() = graph_.landmark(id).p_by_chart();
  to_point(2, 1) = -graph_.height_m(id) / rho_per_m;
  to_point(2, 2) = 1.0 / rho_per_m;
  return to_point * factor_.covariance(blocks, graph_) * to_point.transpose();
}

// Noise estimates from residuals by variance components (Foerstner 1979). The traces are estimated with random signs.

/// Number of the residuals in `signed_sum` that the unknowns take up, estimated with random signs.
template <typename SignedSum>
double Smoother::taken_up(const SignedSum& signed_sum) const {
  double taken = 0.0;
  for (std::uint64_t seed = 0; seed < kProbes; ++seed) {
    Eigen::VectorXd sum = signed_sum(seed);
    factor_.forwards(sum);
    taken += sum.squaredNorm() / kProbes;
  }
  return taken;
}

Smoother::Noise Smoother::bearing_noise() const {
  const BearingGraph::Misfit misfit = graph_.misfit_of_bearings();
  const double taken = taken_up([this](std::uint64_t seed) { return graph_.signed_sum_of_bearings(seed); });
  return noise_by(misfit.chi2 / expected_chi2(settings_.kernel, settings_.kernel_width), misfit.residuals - taken);
}

Smoother::Noise Smoother::odometry_noise(int stride) const {
  const BearingGraph::Misfit misfit = graph_.misfit_of_odometry(stride);
  const double taken =
      taken_up([this, stride](std::uint64_t seed) { return graph_.signed_sum_of_odometry(seed, stride); });
  return noise_by(misfit.chi2, misfit.residuals - taken);
}

/// The unknowns follow the rig's errors; what they take up of the curvature tells nothing (Schur complement). It is
/// nearly all of it, so the factor must be exact, and what is left of the gradient counts.
RigEvidence<kCalibrations> Smoother::rig_evidence() const {
  Smoother exact = *this;
  exact.start_factor_anew();
  exact.optimise(0);
  BearingGraph::ByCalibration by = exact.graph_.by_calibration();
  Eigen::VectorXd gradient = exact.graph_.gradient();
  exact.factor_.forwards(gradient);
  for (int i = 0; i < kCalibrations; ++i) {
    if (!(by.curvature(i, i) > 0.0)) continue;
    Eigen::VectorXd column = by.mixed.col(i);
    exact.factor_.forwards(column);
    by.mixed.col(i) = column;
  }
  RigEvidence<kCalibrations> evidence{.information = by.curvature - by.mixed.transpose() * by.mixed,
                                      .pull = by.mixed.transpose() * gradient - by.slope};
  for (int i = 0; i < kCalibrations; ++i) {
    if (evidence.information(i, i) > kLeastShareTold * by.curvature(i, i)) continue;
    evidence.information.row(i).setZero();
    evidence.information.col(i).setZero();
    evidence.pull[i] = 0.0;
  }
  return evidence;
}

void Smoother::scale_noise(double bearings, double odometry) {
  graph_.scale_noise(bearings, odometry);
  factor_.mark_all_stale();
}

}  // namespace azimuth
