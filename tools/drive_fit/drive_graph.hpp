#pragma once
// A drive as a graph. A first pass processes the drive image by image as in live operation; the whole graph can then be
// solved repeatedly.

#include <cstddef>
#include <limits>
#include <vector>

#include "slam/hindsight/hindsight_settings.hpp"
#include "slam/smoother/smoother.hpp"
#include "tools/drive_fit/drive.hpp"
#include "tools/drive_fit/rig_guess.hpp"

namespace azimuth {

/// The data association of all bearings, and estimates of all poses and landmarks.
struct DriveGraph {
  struct Seen {
    LandmarkId landmark = 0;
    Bearing bearing;  ///< in the camera's frame, as in the drive
  };
  struct Place {
    Stamp stamp{};
    double moving_s = 0.0;  ///< time in motion since the previous place, for which the odometry floors apply
    std::vector<Seen> seen;
  };
  std::vector<Place> places;
  std::vector<char> has_prior;  ///< for each landmark: whether the inverse-depth prior applies
  BearingGraph::Values values;

  std::size_t bearings() const;
};

/// The numbers of a guess that a fit may change, each with the standard deviation of the change. Zero fixes a number.
using FreeErrors = CalibrationPriors;

/// Processes the drive image by image. The bearings' identities give the data association. A landmark that later
/// bearings contradict is initialised again.
DriveGraph followed(const Drive& drive, const RigGuess& guess, const FreeErrors& free,
                    const HindsightSettings& settings);

/// The graph without the bearings of the places in [first, end).
DriveGraph without(const DriveGraph& graph, std::size_t first, std::size_t end);
/// The graph mirrored at the x axis.
DriveGraph mirrored(DriveGraph graph);

struct DriveSolution {
  RigGuess guess;
  DriveGraph graph;
  /// Covariance of numbers_of(guess); zero for numbers that were not free.
  Eigen::Matrix<double, kCalibrations, kCalibrations> covariance =
      Eigen::Matrix<double, kCalibrations, kCalibrations>::Zero();
  /// Negative log likelihood up to a constant. It excludes the priors of the calibration errors and includes a penalty
  /// for landmarks that lie behind their bearings.
  double energy = 0.0;
  double fitting = 0.0;  ///< share of the bearings that the robust kernel listens to
  bool converged = false;
};

/// The likeliest drive, with `graph` and `guess` as starting point. Errors of any size can be found: `free` limits each
/// round of the optimisation, and the prior is centred on the guess of the previous round.
DriveSolution solved(const Drive& drive, DriveGraph graph, RigGuess guess, const FreeErrors& free,
                     const HindsightSettings& settings);

/// followed(), then solved(). A guess that is far off makes each image expensive. The function therefore stops when the
/// energy exceeds `hopeless` before the end of the drive; the solution is then not converged and has that energy.
DriveSolution followed_and_solved(const Drive& drive, const RigGuess& guess, const FreeErrors& free,
                                  const HindsightSettings& settings,
                                  double hopeless = std::numeric_limits<double>::infinity());

/// A smoother with the solved graph, which gives access to covariances of poses and landmarks.
Smoother smoother_of(const Drive& drive, const DriveGraph& graph, const RigGuess& guess, const FreeErrors& free,
                     const HindsightSettings& settings);

}  // namespace azimuth
