#include "slam/hypotheses/member_settings.hpp"

#include <array>
#include <cmath>

namespace azimuth {
namespace {

/// Spreads a setting evenly over [low, high) for any number of members. The irrational stride acts like a golden
/// section; each setting has its own stride.
double spread(int member, double stride, double low, double high) {
  const double turns = member * stride;
  return low + (turns - std::floor(turns)) * (high - low);
}

}  // namespace

std::vector<MemberSettings> differing_members(int count) {
  constexpr std::array kKernels{RobustKernel::cauchy, RobustKernel::dcs, RobustKernel::huber};
  std::vector<MemberSettings> members;
  for (int i = 0; i < count; ++i) {
    MemberSettings member;
    if (i > 0) {
      member.window = static_cast<int>(std::lround(spread(i, 0.6180339887, 9.0, 20.0)));
      member.min_hits = spread(i, 0.4142135624, 0.0, 1.0) < 0.5 ? 4 : 5;
      member.min_fall = spread(i, 0.7320508076, 4.0, 10.0);
      member.rival_gap = spread(i, 0.2360679775, 1.0, 2.0);
      member.merge_margin = spread(i, 0.3166247904, 2.0, 5.0);
      member.missed_scale = spread(i, 0.6457513111, 0.0, 1.0) < 0.5 ? 1.0 : 1.3;
      member.kernel = kKernels[static_cast<std::size_t>(i) % kKernels.size()];
    }
    if (i % 4 > 1) member.anchors = 3;
    if (i % 4 == 3) member.past_stands = false;
    if (i % 2 == 1) {
      member.step_fall = 2.0;
      member.min_log_ratio = 3.0;
    }
    members.push_back(member);
  }
  return members;
}

}  // namespace azimuth
