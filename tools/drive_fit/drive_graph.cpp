#include "tools/drive_fit/drive_graph.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "slam/geometry/index.hpp"
#include "slam/smoother/known_names.hpp"
#include "tools/drive_fit/drive_motions.hpp"

namespace azimuth {
namespace {

constexpr double kLeastFloor = 1e-6;  // odometry between two poses is never exact
constexpr double kShortest_s = 1e-3;
constexpr int kMostIterations = 60, kMostRounds = 8;
constexpr double kSettledShare = 0.03;  // a change below this fraction of a standard deviation counts as converged
// A landmark that fits nowhere may move for ever, and the numbers with it, while the likelihood stays the same. A block
// of kIterationsAtOnce iterations, and each round, must therefore reduce the energy by kWorthwhile (a log likelihood).
constexpr int kIterationsAtOnce = 10;
constexpr double kWorthwhile = 0.1;
constexpr int kRoundsBeforeCreep = 2;

SmootherSettings smoother_settings(const FreeErrors& free, const HindsightSettings& hindsight) {
  SmootherSettings settings;
  settings.inverse_depth_mean_per_m = hindsight.inverse_depth_mean_per_m;
  settings.inverse_depth_sigma_per_m = hindsight.inverse_depth_sigma_per_m;
  settings.kernel = hindsight.kernel;
  settings.kernel_width = hindsight.kernel_width;
  settings.max_iterations = hindsight.max_iterations;
  settings.calibration = free;
  settings.charts_go_along = true;
  return settings;
}

KnownNamesSettings names_settings(const RigGuess& guess, const FreeErrors& free, const HindsightSettings& hindsight) {
  KnownNamesSettings settings;
  settings.smoother = smoother_settings(free, hindsight);
  settings.sigma_bearing_rad = guess.rig.camera.sigma_bearing_rad;
  settings.thinning_s = hindsight.thinning_s;
  settings.reinitialise_after = hindsight.reinitialise_after;
  settings.floors = {.distance_m = std::max(kLeastFloor, guess.rig.odometry.floor_distance_m),
                     .rotation_rad = std::max(kLeastFloor, guess.rig.odometry.floor_rotation_rad)};
  return settings;
}

std::vector<Stamp> stamps_of(const auto& places) {
  std::vector<Stamp> stamps;
  for (const auto& place : places) stamps.push_back(place.stamp);
  return stamps;
}

/// Renumbers the landmarks in the order of their first bearing and drops landmarks without bearings.
DriveGraph numbered_anew(DriveGraph graph) {
  std::vector<LandmarkId> now(graph.has_prior.size(), kOfNothing);
  DriveGraph result;
  result.values.poses = std::move(graph.values.poses);
  result.values.calibration = graph.values.calibration;
  for (DriveGraph::Place& place : graph.places)
    for (DriveGraph::Seen& seen : place.seen) {
      const std::size_t before = as_size(seen.landmark);
      if (now[before] == kOfNothing) {
        now[before] = static_cast<LandmarkId>(result.has_prior.size());
        result.has_prior.push_back(graph.has_prior[before]);
        result.values.landmarks.push_back(graph.values.landmarks[before]);
      }
      seen.landmark = now[before];
    }
  result.places = std::move(graph.places);
  return result;
}

/// Resets diverged landmarks to their first ray with the prior inverse depth. A drive that fits nothing may leave a
/// landmark at the position of the robot, where a chart that moves with its pose diverges.
void tame(DriveGraph& graph, const RigGuess& guess, const SmootherSettings& settings) {
  std::vector<char> looked_at(graph.has_prior.size());
  for (std::size_t place = 0; place < graph.places.size(); ++place)
    for (const DriveGraph::Seen& seen : graph.places[place].seen) {
      const std::size_t id = as_size(seen.landmark);
      if (std::exchange(looked_at[id], 1) != 0) continue;
      SmoothedLandmark& landmark = graph.values.landmarks[id];
      const bool sane = landmark.p_map_chart.allFinite() && std::isfinite(landmark.direction_rad) &&
                        std::abs(landmark.inverse_distance_per_m) * settings.min_distance_m < 1.0;
      if (sane) continue;
      const Pose2& T_map_body = graph.values.poses[place].T_map_body;
      landmark = {T_map_body.position(), T_map_body.heading_rad + robot_azimuth(seen.bearing, guess),
                  settings.inverse_depth_mean_per_m};
      graph.has_prior[id] = 1;
    }
}

/// The energy of a drive in which every bearing has the largest possible residual.
double worst_energy(const DriveGraph& graph, const SmootherSettings& settings) {
  double energy = 0.0;
  for (const DriveGraph::Place& place : graph.places)
    for (const DriveGraph::Seen& seen : place.seen)
      energy += kernel_value(settings.kernel, settings.kernel_width, std::pow(kPi / seen.bearing.sigma_rad, 2)).energy;
  return energy;
}

/// Builds the graph of a drive image by image.
class Follower {
 public:
  Follower(const RigGuess& guess, const KnownNamesSettings& settings) : guess_(guess), names_(settings) {}

  void begin(const BearingSet& set) {
    graph_.places.push_back({set.stamp, 0.0, {}});
    hear(set);
  }
  void go_on(const Motion& motion, const BearingSet& set) {
    names_.predict(motion);
    if (motion.moved()) moving_s_ += to_seconds(set.stamp - last_);
    hear(set);
  }

  double energy() const { return names_.smoother().energy(); }
  DriveGraph graph() {
    const BearingGraph& solved = names_.smoother().graph();
    for (std::size_t place = 0; place < graph_.places.size(); ++place)
      for (std::size_t i = 0; i < graph_.places[place].seen.size(); ++i)
        graph_.places[place].seen[i].landmark = solved.landmark_of(ids_[place][i]);
    for (LandmarkId id = 0; id < solved.landmarks(); ++id) graph_.has_prior.push_back(solved.has_prior(id) ? 1 : 0);
    graph_.values = solved.values();
    return numbered_anew(std::move(graph_));
  }

 private:
  void hear(const BearingSet& set) {
    last_ = set.stamp;
    in_robot_ = set;
    for (Bearing& bearing : in_robot_.bearings) {
      bearing.azimuth_rad = robot_azimuth(bearing, guess_);
      bearing.elevation_rad = std::numeric_limits<double>::quiet_NaN();  // the fit is planar
    }
    if (!names_.update(in_robot_)) return;
    const BearingGraph& solved = names_.smoother().graph();
    if (as_size(solved.poses()) > graph_.places.size()) {
      graph_.places.push_back({set.stamp, moving_s_, {}});
      moving_s_ = 0.0;
    }
    ids_.resize(graph_.places.size());
    BearingId id = names_.last_image().first;
    for (std::size_t i = 0; i < set.bearings.size() && id < solved.bearings(); ++i) {
      if (in_robot_.bearings[i].identity == kUnknownIdentity ||
          in_robot_.bearings[i].azimuth_rad != solved.bearing(id).azimuth_rad)
        continue;
      Bearing bearing = set.bearings[i];
      bearing.sigma_rad = solved.bearing(id).sigma_rad;
      graph_.places.back().seen.push_back({0, bearing});
      ids_.back().push_back(id++);
    }
    assert(id == solved.bearings());
  }

  RigGuess guess_;
  KnownNames names_;
  DriveGraph graph_;
  std::vector<std::vector<BearingId>> ids_{1};  // for each place: the ids of its bearings in the smoother's graph
  BearingSet in_robot_;
  Stamp last_{};
  double moving_s_ = 0.0;
};

/// Processes the drive. Returns false if the energy exceeded `hopeless` before the end.
bool follow(Follower& follower, const Drive& drive, const RigGuess& guess, double hopeless) {
  const auto motions = motions_between(drive.odometry, guess, stamps_of(drive.sets));
  follower.begin(drive.sets.front());
  for (std::size_t i = 1; i < drive.sets.size(); ++i) {
    follower.go_on(motions[i].motion, drive.sets[i]);
    if (follower.energy() > hopeless) return false;
  }
  return true;
}

/// A smoother that starts at the values of `graph`, not optimised.
Smoother put_together(const Drive& drive, const DriveGraph& graph, const RigGuess& guess, const FreeErrors& free,
                      const HindsightSettings& hindsight) {
  const KnownNamesSettings settings = names_settings(guess, free, hindsight);
  const auto motions = motions_between(drive.odometry, guess, stamps_of(graph.places));
  Smoother smoother(settings.smoother, graph.values.poses.front().T_map_body);
  for (std::size_t i = 0; i < graph.places.size(); ++i) {
    const DriveGraph::Place& place = graph.places[i];
    if (i > 0) {
      Motion motion = motions[i].motion;
      const MotionFloors& floors = settings.floors;
      motion.covariance.diagonal() +=
          std::max(place.moving_s, kShortest_s) *
          Eigen::Array3d(floors.distance_m, floors.distance_m, floors.rotation_rad).square().matrix();
      smoother.add_pose(motion, motions[i].by_lag);
    }
    for (const DriveGraph::Seen& seen : place.seen) {
      const BearingId id = smoother.add_bearing(robot_azimuth(seen.bearing, guess), seen.bearing.sigma_rad,
                                                std::nullopt, by_centre(seen.bearing, guess));
      if (seen.landmark == smoother.graph().landmarks())
        smoother.add_landmark(id);
      else
        smoother.assign(id, seen.landmark);
    }
  }
  for (std::size_t i = 0; i < graph.has_prior.size(); ++i)
    smoother.use_prior(static_cast<LandmarkId>(i), graph.has_prior[i] != 0);
  BearingGraph::Values values = graph.values;
  values.calibration.setZero();
  smoother.begin_at(values);
  return smoother;
}

double energy_of_errors(const Smoother& smoother, const FreeErrors& free) {
  const Calibration sigma = sigmas(free);
  double energy = 0.0;
  for (Eigen::Index i = 0; i < kCalibrations; ++i)
    if (sigma[i] > 0.0) energy += 0.5 * std::pow(smoother.graph().calibration()[i] / sigma[i], 2);
  return energy;
}

/// Energy of landmarks that lie behind their bearings (negative inverse distance). The graph accepts them, so that a
/// camera mounted backwards would fit as well as a correct one. Each such landmark costs the energy of moving it to the
/// far end of its rays, and at most the energy of its bearings if none of them fitted.
double energy_of_behind(const BearingGraph& graph) {
  double energy = 0.0;
  for (LandmarkId id = 0; id < graph.landmarks(); ++id) {
    const double rho = graph.landmark(id).inverse_distance_per_m;
    if (!graph.is_unknown(id) || rho >= 0.0) continue;
    const double most = 0.5 * kFitsChi2 * static_cast<double>(graph.bearings_of(id).size());
    energy += std::min(0.5 * rho * rho * graph.told_information(id), most);
  }
  return energy;
}

/// Optimises. Returns true if the optimisation converged, false if it stopped without progress.
bool settle(Smoother& smoother) {
  double before = std::numeric_limits<double>::infinity();
  for (int iterations = 0; iterations < kMostIterations; iterations += kIterationsAtOnce) {
    if (smoother.optimise(kIterationsAtOnce).converged) return true;
    if (before - smoother.energy() < kWorthwhile) return false;
    before = smoother.energy();
  }
  return false;
}

double share_fitting(const BearingGraph& graph) {
  BearingId fitting = 0;
  for (BearingId id = 0; id < graph.bearings(); ++id) fitting += graph.chi2_of(id) < kFitsChi2 ? 1 : 0;
  return static_cast<double>(fitting) / std::max(1, graph.bearings());
}

}  // namespace

std::size_t DriveGraph::bearings() const {
  std::size_t count = 0;
  for (const Place& place : places) count += place.seen.size();
  return count;
}

DriveGraph followed(const Drive& drive, const RigGuess& guess, const FreeErrors& free,
                    const HindsightSettings& settings) {
  Follower follower(guess, names_settings(guess, free, settings));
  follow(follower, drive, guess, std::numeric_limits<double>::infinity());
  return follower.graph();
}

DriveSolution followed_and_solved(const Drive& drive, const RigGuess& guess, const FreeErrors& free,
                                  const HindsightSettings& settings, double hopeless) {
  Follower follower(guess, names_settings(guess, free, settings));
  if (follow(follower, drive, guess, hopeless)) return solved(drive, follower.graph(), guess, free, settings);
  return {.guess = guess, .graph = follower.graph(), .energy = hopeless};
}

DriveGraph without(const DriveGraph& graph, std::size_t first, std::size_t end) {
  DriveGraph result = graph;
  for (std::size_t i = first; i < end; ++i) result.places[i].seen.clear();
  return numbered_anew(std::move(result));
}

DriveGraph mirrored(DriveGraph graph) {
  for (SmoothedPose& pose : graph.values.poses) {
    const Pose2& T = pose.T_map_body;
    pose = SmoothedPose({T.x_m, -T.y_m, wrap(-T.heading_rad)});
  }
  for (SmoothedLandmark& landmark : graph.values.landmarks)
    landmark = {{landmark.p_map_chart.x(), -landmark.p_map_chart.y()},
                wrap(-landmark.direction_rad),
                landmark.inverse_distance_per_m};
  return graph;
}

DriveSolution solved(const Drive& drive, DriveGraph graph, RigGuess guess, const FreeErrors& free,
                     const HindsightSettings& settings) {
  DriveSolution solution{.guess = std::move(guess), .graph = std::move(graph)};
  const SmootherSettings smoothing = smoother_settings(free, settings);
  const int rounds = free == FreeErrors{} ? 1 : kMostRounds;  // without free numbers nothing is relinearised
  for (int round = 0; round < rounds && !solution.converged; ++round) {
    tame(solution.graph, solution.guess, smoothing);
    Smoother smoother = put_together(drive, solution.graph, solution.guess, free, settings);
    const bool is_solved = settle(smoother);
    const double before = solution.energy;
    const Calibration errors = smoother.graph().calibration();
    const auto covariance = smoother.calibration_covariance();
    solution.graph.values = smoother.graph().values();
    solution.energy = smoother.energy() - energy_of_errors(smoother, free) + energy_of_behind(smoother.graph());
    if (!std::isfinite(solution.energy) || !errors.allFinite()) {
      solution.energy = worst_energy(solution.graph, smoothing);
      return solution;
    }
    solution.fitting = share_fitting(smoother.graph());
    const auto by = by_errors(solution.guess);
    solution.covariance = by * covariance * by.transpose();
    solution.guess = moved(solution.guess, errors);
    const Calibration allowed = kSettledShare * covariance.diagonal().cwiseSqrt();
    solution.converged = is_solved && (errors.array().abs() <= allowed.array()).all();
    const bool creeps = !is_solved && std::abs(before - solution.energy) < kWorthwhile;
    if (creeps && round >= kRoundsBeforeCreep) return solution;
  }
  return solution;
}

Smoother smoother_of(const Drive& drive, const DriveGraph& graph, const RigGuess& guess, const FreeErrors& free,
                     const HindsightSettings& settings) {
  Smoother smoother = put_together(drive, graph, guess, free, settings);
  settle(smoother);
  return smoother;
}

}  // namespace azimuth
