#pragma once
#include <vector>

#include "slam/smoother/robust_kernel.hpp"

namespace azimuth {

/// How one member of a beam decides. None is right everywhere, so members differ on purpose.
struct MemberSettings {
  int window = 12;             ///< images in which landmarks are looked for, and decided about anew at each image
  int anchors = 1;             ///< newest images that a new landmark may have been seen in last
  int min_hits = 4;            ///< bearings that make a landmark
  double min_fall = 6.0;       ///< of the energy, by landmarks that come together
  double step_fall = 1.0;      ///< likewise, by each of them but the first
  double min_log_ratio = 2.0;  ///< of a landmark's bearings being of it, against being of anything
  double rival_gap = 1.5;      ///< a bearing is of no landmark when the second best is nearer than this, in energy
  bool past_stands = true;     ///< a pair needs no gap to stay, before the window either
  double merge_margin = 3.0;   ///< ln of the odds that two landmarks are one, against the best rival
  double missed_scale = 1.0;   ///< times the cost of a landmark not seen
  RobustKernel kernel = RobustKernel::cauchy;
  friend bool operator==(const MemberSettings&, const MemberSettings&) = default;
};

/// Members that differ, the first being the most usual. Same count, same settings.
std::vector<MemberSettings> differing_members(int count);

}  // namespace azimuth
