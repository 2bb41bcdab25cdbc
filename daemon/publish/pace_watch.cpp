#include "daemon/publish/pace_watch.hpp"

#include <fmt/format.h>

namespace azimuth {
namespace {

constexpr std::chrono::seconds kWindow{5};
constexpr double kMany = 0.1;          // fraction of skipped samples from which on the skipping is reported
constexpr std::uint64_t kEnough = 10;  // samples needed for a judgement

double interval_ms(double window_s, std::uint64_t count) { return 1e3 * window_s / static_cast<double>(count); }

bool are_many(std::uint64_t left_out, std::uint64_t came) {
  return came >= kEnough && static_cast<double>(left_out) > kMany * static_cast<double>(came);
}

int percent(std::uint64_t part, std::uint64_t whole) {
  return static_cast<int>(100.0 * static_cast<double>(part) / static_cast<double>(whole) + 0.5);
}

}  // namespace

void PaceWatch::look(Clock::time_point now, const Status& status) {
  const Counts counts{now, status.perception.frames, status.wires.frames_replaced, status.wires.bearings_refused,
                      status.estimate.step};
  if (before_.at == Clock::time_point{}) before_ = counts;
  if (now - before_.at < kWindow) return;
  text_ = judged(before_, counts, status.perception.detect_mean_us);
  before_ = counts;
}

std::string PaceWatch::judged(const Counts& before, const Counts& now, double detect_mean_us) {
  const double window_s = std::chrono::duration<double>(now.at - before.at).count();
  const std::uint64_t looked = now.looked - before.looked, replaced = now.replaced - before.replaced;
  const std::uint64_t refused = now.refused - before.refused, steps = now.steps - before.steps;
  if (are_many(replaced, looked + replaced))
    return fmt::format(
        "images come every {:.0f} ms and are worked off every {:.0f} ms, of which finding bearings takes {:.0f} ms: "
        "{} % are left out; ask the camera for fewer or smaller ones (rate_hz), or give the estimator less to do",
        interval_ms(window_s, looked + replaced), interval_ms(window_s, looked > 0 ? looked : 1), 1e-3 * detect_mean_us,
        percent(replaced, looked + replaced));
  if (are_many(refused, steps + refused))
    return fmt::format(
        "bearings come every {:.0f} ms and a step takes {:.0f} ms: {} % are left out; send fewer, or give the "
        "estimator less to do (docs/tuning.md)",
        interval_ms(window_s, steps + refused), interval_ms(window_s, steps > 0 ? steps : 1),
        percent(refused, steps + refused));
  return {};
}

}  // namespace azimuth
