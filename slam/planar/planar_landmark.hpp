#pragma once
#include <cstdint>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// The planar filter's bookkeeping for a landmark, apart from its state.
struct PlanarLandmark {
  std::int64_t id = 0;
  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;
  BlockKind block_kind = BlockKind::point;
  Index block = 0;
  std::uint64_t sightings = 0;  ///< Bearings accepted
  int rejected_in_row = 0;      ///< Bearings rejected since the last accepted one
  double last_used_m = 0.0;     ///< Path driven when the landmark was last seen
  Stamp last_used{};
  double radius_px = BearingEkf::kNoRadius;  ///< Distance of the last accepted bearing from the image's centre
  bool recalled = false;                     ///< Loaded from a saved map, and not seen since the start
  bool confirmed = false;                    ///< Past probation: published and saved

  bool is_point() const { return block_kind == BlockKind::point; }

  void was_seen(double at_radius_px, double path_m, Stamp stamp) {
    radius_px = at_radius_px;
    last_used_m = path_m;
    last_used = stamp;
    rejected_in_row = 0;
    recalled = false;
    ++sightings;
  }
};

}  // namespace azimuth
