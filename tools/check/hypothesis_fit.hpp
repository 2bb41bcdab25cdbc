#pragma once
// Internal to tools/check: fits a drive under the hypothesis of one mistake.

#include <optional>
#include <vector>

#include "tools/check/mistakes.hpp"
#include "tools/drive_fit/short_stretches.hpp"

namespace azimuth {

/// The fit of a drive with one mistake corrected.
struct Explanation {
  Mistake mistake = Mistake::hand;
  int adjusted = 0;  ///< number of parameters that the fit adjusts for this mistake
  FreeErrors free;   ///< the parameters that are free in the fit
  DriveSolution solution;
};

/// Tries one mistake after another on the same drive. Borrows the drive and the settings. Thread contract:
/// thread-bound.
class Explanations {
 public:
  Explanations(const Drive& drive, const Rig& said, const HindsightSettings& settings);

  /// The fit with all mistakes corrected that were accepted so far.
  const DriveSolution& now() const { return now_; }
  void accept(const DriveSolution& solution);

  /// Fits the drive with `mistake` corrected. Nothing if this drive cannot be tested for the mistake.
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
  double least_energy_ = 0.0;  // least energy of all fits since the last accepted one
  bool has_radii_ = false;
};

}  // namespace azimuth
