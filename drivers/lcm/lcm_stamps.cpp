#include "drivers/lcm/lcm_stamps.hpp"

#include "drivers/io/plausible.hpp"

namespace azimuth {

std::optional<Stamp> LcmStamps::judge(Stamp said, const LcmReceipt& receipt) {
  Stamp stamp = receipt.stamp;
  if (kind_ == LcmStampKind::sender) {
    // Far ones first: with them the differences below could overflow.
    if (to_us(said) < 0 || !is_plausible_stamp(to_us(said))) {
      ++(to_us(said) < 0 ? counts_.too_old : counts_.in_future);
      return std::nullopt;
    }
    stamp = said - receipt.wall_lead;
    if (stamp < receipt.stamp - max_age_) {
      ++counts_.too_old;
      return std::nullopt;
    }
    if (stamp > receipt.stamp + kTolerance) {
      ++counts_.in_future;
      return std::nullopt;
    }
  }
  if (stamp <= newest_) {
    ++counts_.out_of_order;
    return std::nullopt;
  }
  newest_ = stamp;
  return stamp;
}

}  // namespace azimuth
