#include "drivers/lcm/lcm_stamps.hpp"

#include "drivers/wire/plausible.hpp"

namespace azimuth {

std::optional<Stamp> LcmStamps::judge(Stamp said, const LcmReceipt& receipt) {
  const std::optional<Stamp> stamp = kind_ == LcmStampKind::sender ? by_sender(said, receipt) : receipt.stamp;
  if (!stamp) return std::nullopt;
  if (*stamp <= newest_) {
    ++counts_.out_of_order;
    return std::nullopt;
  }
  newest_ = *stamp;
  return stamp;
}

std::optional<Stamp> LcmStamps::by_sender(Stamp said, const LcmReceipt& receipt) {
  // Distant times are handled first, because the differences below could overflow with them.
  if (to_us(said) < 0) return misdated(counts_.too_old, said, receipt);
  if (!is_plausible_stamp(to_us(said))) return misdated(counts_.in_future, said, receipt);
  const Stamp stamp = said - receipt.wall_lead;
  if (stamp < receipt.stamp - max_age_) return misdated(counts_.too_old, said, receipt);
  if (stamp > receipt.stamp + kTolerance) return misdated(counts_.in_future, said, receipt);
  return stamp;
}

std::nullopt_t LcmStamps::misdated(std::uint64_t& count, Stamp said, const LcmReceipt& receipt) {
  ++count;
  counts_.last_off_s = to_seconds(said) - to_seconds(receipt.stamp) - to_seconds(receipt.wall_lead);
  return std::nullopt;
}

}  // namespace azimuth
