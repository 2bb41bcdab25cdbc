// A robot that is carried away below lamps which it has mapped itself.

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "slam/ceiling/lamp_ekf_estimator.hpp"
#include "tests/support/lamp_run.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kTaken = 160;    // image number; a round is mapped by then
constexpr std::size_t kNearest = 180;  // first image at which it may be put down
constexpr double kPatience_m = 5.0;    // ten seconds of driving
constexpr double kWrong_m = 0.5, kOff_m = 0.8;

/// The number of seeds, from the environment variable AZIMUTH_LAMP_SEEDS. A hundred seeds take some seconds.
int kidnapped_seeds() {
  const char* wanted = std::getenv("AZIMUTH_LAMP_SEEDS");
  return wanted != nullptr ? std::max(1, std::atoi(wanted)) : 6;
}

struct Kidnapped {
  double noticed_m = -1.0, found_m = -1.0;  ///< Distance driven until then; negative: never
  bool wrong = false;                       ///< Whether a wrong pose was reported as found
  double error_m = 0.0;                     ///< Position error at the end
  std::size_t lamps = 0;
};

/// The robot is switched off while it is carried, so odometry does not measure the motion.
Kidnapped kidnap(const LampRun& run, std::size_t put_down) {
  Kidnapped outcome;
  LampEkfEstimator ekf(run.rig, {});
  const auto step = [&](std::size_t image) {
    ekf.predict(run.motions[image]);
    ekf.update(run.sets[image]);
  };
  for (std::size_t image = 0; image < kTaken; ++image) step(image);
  EXPECT_FALSE(ekf.searching()) << "lost on a drive where nothing happened";
  double driven_m = 0.0;
  Estimate now;
  for (std::size_t image = put_down; image < run.sets.size(); ++image) {
    step(image);
    driven_m += run.motions[image].path_m;
    now.landmarks.clear();
    ekf.estimate(now);
    if (ekf.searching() && outcome.noticed_m < 0.0) outcome.noticed_m = driven_m;
    const Pose2 truth = inverse(run.truth[0]) * run.truth[image];
    outcome.error_m = (now.T_map_body.position() - truth.position()).norm();
    if (outcome.noticed_m < 0.0 || ekf.searching()) continue;
    if (outcome.found_m < 0.0) outcome.found_m = driven_m;
    outcome.wrong = outcome.wrong || outcome.error_m > kWrong_m;
  }
  outcome.lamps = now.landmarks.size();
  return outcome;
}

TEST(KidnappedBelowLamps, IsNoticedAndFound) {
  int found = 0, wrong = 0, whole = 0;
  std::vector<double> noticed_m, found_m;
  for (int seed = 1; seed <= kidnapped_seeds(); ++seed) {
    const Kidnapped outcome = kidnap(simulated_hall(static_cast<std::uint64_t>(seed), kOff_m),
                                     kNearest + static_cast<std::size_t>(seed) * 37 % 100);
    if (std::getenv("AZIMUTH_VERBOSE") != nullptr)
      fmt::print("seed {:>3}: noticed {:.2f} m, found {:.2f} m, wrong {}, error {:.3f} m, {} lamps\n", seed,
                 outcome.noticed_m, outcome.found_m, outcome.wrong, outcome.error_m, outcome.lamps);
    found += outcome.found_m >= 0.0 && outcome.found_m <= kPatience_m && !outcome.wrong ? 1 : 0;
    wrong += outcome.wrong || (outcome.noticed_m < 0.0 && outcome.error_m > kWrong_m) ? 1 : 0;
    whole += outcome.lamps == 16 ? 1 : 0;
    noticed_m.push_back(outcome.noticed_m);
    found_m.push_back(outcome.found_m);
  }
  std::ranges::sort(noticed_m);
  std::ranges::sort(found_m);
  fmt::print(
      "kidnapped: found within {} m {} of {}, wrong {}, median noticed after {:.2f} m, found {:.2f} m, map whole {}\n",
      kPatience_m, found, kidnapped_seeds(), wrong, noticed_m[noticed_m.size() / 2], found_m[found_m.size() / 2],
      whole);
  EXPECT_GE(found, 0.95 * kidnapped_seeds());
  EXPECT_LE(wrong, 0.01 * kidnapped_seeds());
}

}  // namespace
}  // namespace azimuth
