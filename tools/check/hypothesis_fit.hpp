#pragma once
// Internal to tools/check: a drive with one thing wrong.

#include <optional>
#include <vector>

#include "tools/check/mistakes.hpp"
#include "tools/drive_fit/short_stretches.hpp"

namespace azimuth {

/// A drive as one mistake would explain it, put right.
struct Explanation {
  Mistake mistake = Mistake::hand;
  int adjusted = 0;  ///< numbers
  FreeErrors free;   ///< that were looked for
  DriveSolution solution;
};

/// Tries one mistake after another on the same drive. Borrows the drive and the settings. Thread contract:
/// thread-bound.
class Explanations {
 public:
  Explanations(const Drive& drive, const Rig& said, const HindsightSettings& settings);

  /// With what has been put right so far.
  const DriveSolution& now() const { return now_; }
  void accept(const DriveSolution& solution);

  /// Nothing: it cannot be looked for in this drive.
  std::optional<Explanation> explanation(Mistake mistake);

 private:
  std::optional<Explanation> tried(Mistake mistake);
  DriveSolution begun_anew(const RigGuess& guess, const FreeErrors& free) const;
  DriveSolution better(const DriveSolution& a, const DriveSolution& b) const;
  DriveSolution with_free(const FreeErrors& free, const RoughSearch& search);
  DriveSolution mirrored_camera();
  DriveSolution swapped_wheels();
  DriveSolution mounted_elsewhere();
  DriveSolution jumped_when_it_fits_best(DriveSolution jumped) const;

  const Drive& drive_;
  Rig said_;
  const HindsightSettings& settings_;
  ShortStretches stretches_;
  DriveSolution now_;
  double least_energy_ = 0.0;  // of all that was tried since something was accepted
  bool has_radii_ = false;
};

}  // namespace azimuth
