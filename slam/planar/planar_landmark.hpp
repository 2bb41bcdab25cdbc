#pragma once
#include <cstdint>

#include "slam/ekf/bearing_ekf.hpp"
#include "slam/sample/bearings.hpp"

namespace azimuth {

/// What the planar filter knows of a landmark beside its state.
struct PlanarLandmark {
  std::int64_t id = 0;
  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;
  BlockKind block_kind = BlockKind::point;
  Index block = 0;
  std::uint64_t sightings = 0;  ///< bearings accepted
  int rejected_in_row = 0;      ///< since the last accepted one
  double last_used_m = 0.0;     ///< path driven by then
  Stamp last_used{};
  double radius_px = BearingEkf::kNoRadius;  ///< of the last bearing accepted
  bool recalled = false;                     ///< from a saved map, and not seen since the start
  bool confirmed = false;                    ///< believed to be there: others hear of it

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
