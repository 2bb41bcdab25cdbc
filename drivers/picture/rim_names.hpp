#pragma once
// Internal to drivers/picture.

#include <string>
#include <vector>

#include "drivers/picture/canvas.hpp"

namespace azimuth {

/// Places names round a mirror's rim, each as near to its azimuth as the space beside the other names permits.
///
/// Thread contract: thread-bound. Storage is kept from picture to picture.
class RimNames {
 public:
  struct Name {
    double azimuth_rad = 0.0;  ///< The azimuth of the landmark
    std::string text;
    PictureColour colour{};
    double placed_rad = 0.0;  ///< The azimuth at which the name is written
  };

  void clear() { names_.clear(); }
  void add(double azimuth_rad, std::string text, const PictureColour& colour);

  /// Moves the names apart so that they do not overlap. If there is not room for all, they share the rim evenly.
  const std::vector<Name>& placed(double radius_px);

 private:
  void begin_after_the_widest_gap();

  std::vector<Name> names_;
};

}  // namespace azimuth
