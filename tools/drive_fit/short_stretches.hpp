#pragma once
// Finds a rough guess as the starting point of a fit. It uses short stretches of the drive, on which odometry is nearly
// free of error.

#include <optional>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "tools/drive_fit/drive.hpp"
#include "tools/drive_fit/rig_guess.hpp"

namespace azimuth {

/// Rates a guess by how well the bearings of each landmark intersect in one point, stretch by stretch. The computing
/// time does not depend on the guess, and an exhaustive search over guesses cannot end in a local minimum.
///
/// Borrows the drive. Thread contract: thread-bound.
class ShortStretches {
 public:
  ShortStretches(const Drive& drive, const Rig& rig);

  /// Mean cost per bearing: 0 if all rays intersect exactly, kMostCost if none do.
  double cost(const RigGuess& guess);
  static constexpr double kMostCost = 4.5;
  /// The summed cost of the bearings of each stretch; starts() has the first instant of each stretch.
  std::vector<double> costs(const RigGuess& guess);
  const std::vector<Stamp>& starts() const { return starts_; }

  /// Number of bearings that enter the cost: those of landmarks seen often enough within a stretch.
  std::size_t judged() const { return judged_; }

 private:
  struct Ray {
    std::size_t set = 0, bearing = 0;
  };
  using Landmark = std::vector<Ray>;  // the bearings of one landmark on one stretch

  void pose_for(const RigGuess& guess);
  void find_landmarks(std::size_t first, std::size_t end);
  double cost_of(const Landmark& landmark, const RigGuess& guess, const std::vector<Pose2>& poses);

  const Drive& drive_;
  std::vector<Stamp> stamps_;
  std::vector<Landmark> landmarks_;
  std::vector<Stamp> starts_;            // first instant of each stretch
  std::vector<std::size_t> stretch_of_;  // index of the stretch of each element of landmarks_
  std::size_t judged_ = 0;
  std::optional<RigGuess> posed_for_;
  std::vector<Pose2> poses_;
};

/// The values of a guess that a rough search may change.
struct RoughSearch {
  bool hand = false, yaw = false, turn = false, lag = false;
};

/// The best guess for each allowed azimuth direction, the better one first.
std::vector<RigGuess> rough_guesses(ShortStretches& stretches, const RigGuess& guess, const RoughSearch& search);

}  // namespace azimuth
