#pragma once
#include <vector>

#include "slam/smoother/robust_kernel.hpp"

namespace azimuth {

/// Decision thresholds of one member of a beam. No setting is right everywhere, so members differ on purpose.
struct MemberSettings {
  int window = 12;             ///< newest images searched for landmarks and associated anew with each image
  int anchors = 1;             ///< number of newest images that may hold a new landmark's last bearing
  int min_hits = 4;            ///< minimum number of bearings of a new landmark
  double min_fall = 6.0;       ///< minimum fall of the energy by a set of new landmarks
  double step_fall = 1.0;      ///< minimum fall of the energy by each further landmark of the set
  double min_log_ratio = 2.0;  ///< minimum ln of the odds of a new landmark against chance
  double rival_gap = 1.5;      ///< a bearing stays unassociated if the second best choice costs less than this more
  bool past_stands = true;     ///< whether pairs of images before the window stay although a rival is within rival_gap
  double merge_margin = 3.0;   ///< minimum ln of the odds for merging two landmarks, against the best rival
  double missed_scale = 1.0;   ///< factor on the cost of a missed detection
  RobustKernel kernel = RobustKernel::cauchy;
  friend bool operator==(const MemberSettings&, const MemberSettings&) = default;
};

/// Settings of `count` different members; the first has the defaults. The same count gives the same settings.
std::vector<MemberSettings> differing_members(int count);

}  // namespace azimuth
