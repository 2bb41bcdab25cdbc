#include "slam/smoother/smoother.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

}  // namespace azimuth
