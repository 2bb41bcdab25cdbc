#pragma once
// Where to begin a fit: a rough guess from short stretches of the drive, on each of which odometry is as good as true.

#include <optional>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "tools/drive_fit/drive.hpp"
#include "tools/drive_fit/rig_guess.hpp"

namespace azimuth {

/// Judges guesses by how well the bearings of each landmark meet in a point, stretch by stretch. Whatever is wrong with
/// the rig, a guess costs the same time, and none is a local minimum.
///
/// Borrows the drive. Thread contract: thread-bound.
class ShortStretches {
 public:
  ShortStretches(const Drive& drive, const Rig& rig);

  /// Mean cost of a bearing: 0 where all meet, kMostCost where none does.
  double cost(const RigGuess& guess);
  static constexpr double kMostCost = 4.5;
  /// Sum of its bearings' costs for each stretch, and where each begins.
  std::vector<double> costs(const RigGuess& guess);
  const std::vector<Stamp>& starts() const { return starts_; }

  /// Bearings that can be judged: of landmarks that are seen often enough within a stretch.
  std::size_t judged() const { return judged_; }

 private:
  struct Ray {
    std::size_t set = 0, bearing = 0;
  };
  using Landmark = std::vector<Ray>;  // on one stretch

  void pose_for(const RigGuess& guess);
  void find_landmarks(std::size_t first, std::size_t end);
  double cost_of(const Landmark& landmark, const RigGuess& guess, const std::vector<Pose2>& poses);

  const Drive& drive_;
  std::vector<Stamp> stamps_;
  std::vector<Landmark> landmarks_;
  std::vector<Stamp> starts_;            // of stretches
  std::vector<std::size_t> stretch_of_;  // each of landmarks_
  std::size_t judged_ = 0;
  std::optional<RigGuess> posed_for_;
  std::vector<Pose2> poses_;
};

/// What a rough search may change of a guess.
struct RoughSearch {
  bool hand = false, yaw = false, turn = false, lag = false;
};

/// The best guess of each hand that is allowed, the better one first.
std::vector<RigGuess> rough_guesses(ShortStretches& stretches, const RigGuess& guess, const RoughSearch& search);

}  // namespace azimuth
