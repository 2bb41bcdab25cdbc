#pragma once
// A drive as a graph: followed once as it would go live, then solved as a whole as often as is asked for.

#include <cstddef>
#include <limits>
#include <vector>

#include "slam/hindsight/hindsight_settings.hpp"
#include "slam/smoother/smoother.hpp"
#include "tools/drive_fit/drive.hpp"
#include "tools/drive_fit/rig_guess.hpp"

namespace azimuth {

/// Which bearing is of which landmark, and where all are.
struct DriveGraph {
  struct Seen {
    LandmarkId landmark = 0;
    Bearing bearing;  ///< in the camera's frame, as the drive has it
  };
  struct Place {
    Stamp stamp{};
    double moving_s = 0.0;  ///< on the way here, which floors of odometry count for
    std::vector<Seen> seen;
  };
  std::vector<Place> places;
  std::vector<char> has_prior;  ///< of each landmark
  BearingGraph::Values values;

  std::size_t bearings() const;
};

/// What may differ from the guess, by how much: what is to be found out.
using FreeErrors = CalibrationPriors;

/// As images came: names of landmarks are believed, and a landmark that is contradicted is looked for anew.
DriveGraph followed(const Drive& drive, const RigGuess& guess, const FreeErrors& free,
                    const HindsightSettings& settings);

/// Without the bearings of the places of [first, end).
DriveGraph without(const DriveGraph& graph, std::size_t first, std::size_t end);
/// As a mirror shows it.
DriveGraph mirrored(DriveGraph graph);

struct DriveSolution {
  RigGuess guess;
  DriveGraph graph;
  /// Of numbers_of(guess); of what was not free, zero.
  Eigen::Matrix<double, kCalibrations, kCalibrations> covariance =
      Eigen::Matrix<double, kCalibrations, kCalibrations>::Zero();
  /// Without what was known of the errors before, and with what it costs to have landmarks behind their bearings.
  double energy = 0.0;
  double fitting = 0.0;  ///< share of the bearings that the robust kernel listens to
  bool converged = false;
};

/// The likeliest drive, begun from `graph` and `guess`. Errors are found however large: `free` is how far a step may
/// go, and nothing is held against a guess that goes on to another.
DriveSolution solved(const Drive& drive, DriveGraph graph, RigGuess guess, const FreeErrors& free,
                     const HindsightSettings& settings);

/// Both. With a guess that is far off, each image is dear: when the energy is above `hopeless` before the drive is
/// over, what is left is not looked at, and the solution, which did not converge, has that energy.
DriveSolution followed_and_solved(const Drive& drive, const RigGuess& guess, const FreeErrors& free,
                                  const HindsightSettings& settings,
                                  double hopeless = std::numeric_limits<double>::infinity());

/// The graph as a smoother, solved as it stands with nothing free: for what is told by covariances of poses.
Smoother smoother_of(const Drive& drive, const DriveGraph& graph, const RigGuess& guess, const FreeErrors& free,
                     const HindsightSettings& settings);

}  // namespace azimuth
