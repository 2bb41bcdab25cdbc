#pragma once
// Internal to picture.

#include <string>
#include <vector>

#include "picture/canvas.hpp"

namespace azimuth {

/// Names that stand round a mirror's rim, each at its azimuth or as near to it as there is room beside the others.
///
/// Thread contract: thread-bound. Storage is kept from picture to picture.
class RimNames {
 public:
  struct Name {
    double azimuth_rad = 0.0;  ///< where it belongs
    std::string text;
    PictureColour colour{};
    double placed_rad = 0.0;  ///< where it stands
  };

  void clear() { names_.clear(); }
  void add(double azimuth_rad, std::string text, const PictureColour& colour);

  /// Moves them apart, so that each has as much of the rim as it is long. Where all of them together have no room they
  /// share it.
  const std::vector<Name>& placed(double radius_px);

 private:
  void begin_after_the_widest_gap();

  std::vector<Name> names_;
};

}  // namespace azimuth
