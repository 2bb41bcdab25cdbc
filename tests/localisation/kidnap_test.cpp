// How often and how fast a kidnapped robot is relocalised, and how often at a wrong pose.

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/localisation/kidnapping.hpp"

namespace azimuth {
namespace {

/// The number of seeds, from the environment variable AZIMUTH_KIDNAPPINGS; 8 by default.
int seeds() {
  const char* const asked = std::getenv("AZIMUTH_KIDNAPPINGS");
  return asked != nullptr ? std::max(1, std::atoi(asked)) : 8;
}

struct Kidnappings {
  int found = 0, wrong = 0;
  std::vector<double> after_s;
};

double quantile(const std::vector<double>& sorted, double share) {
  return sorted.empty() ? 0.0 : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

template <class Make>
Kidnappings kidnap_often(const char* title, const Make& make, double seconds = 10.0) {
  Kidnappings all;
  for (int seed = 1; seed <= seeds(); ++seed) {
    RandomDraws draws(static_cast<unsigned>(seed));
    const KidnapWorld world = make(draws);
    const Kidnapping one = kidnap(world, RelocalisationSettings{}, seconds, draws);
    all.found += one.found && !one.wrong ? 1 : 0;
    all.wrong += one.wrong ? 1 : 0;
    if (one.found) all.after_s.push_back(one.after_s);
    if (one.wrong) fmt::print("{}, seed {}: off by {:.2f} m, {:.2f} rad\n", title, seed, one.error_m, one.error_rad);
  }
  std::ranges::sort(all.after_s);
  fmt::print("{}: found {} of {} within {:.0f} s, wrong {}, after {:.1f} s (median), {:.1f} s (90 %)\n", title,
             all.found, seeds(), seconds, all.wrong, quantile(all.after_s, 0.5), quantile(all.after_s, 0.9));
  return all;
}

void expect_found(const Kidnappings& all, double least = 0.95) {
  EXPECT_GE(all.found, static_cast<int>(least * seeds()));
  EXPECT_LE(all.wrong, seeds() / 100);
}

TEST(Kidnapped, IsFoundUnderLampsThatAreNotMountedExactly) {
  expect_found(kidnap_often("lamps", [](RandomDraws& draws) { return lamp_hall(draws, 0.3); }));
}

TEST(Kidnapped, IsFoundAmongColours) {
  expect_found(kidnap_often("kinds", [](RandomDraws& draws) {
    KidnapWorld world = lab(draws);
    world.kinds = true;
    return world;
  }));
}

TEST(Kidnapped, IsFoundAmongColoursOfWhichFewAreInView) {
  const auto few = [](RandomDraws& draws) {
    KidnapWorld world = lab(draws);
    world.kinds = true;
    world.range_m = 2.6;
    world.sigma_rad = 0.01;
    world.map_sigma_m = 0.02;
    return world;
  };
  const auto few_nearby = [&few](RandomDraws& draws) {
    KidnapWorld world = few(draws);
    world.reach_m = 5.0;
    return world;
  };
  const Kidnappings anywhere = kidnap_often("kinds, three or four in view", few, 20.0);
  const Kidnappings nearby = kidnap_often("the same, known to be within 5 m", few_nearby, 20.0);
  expect_found(anywhere, 0.9);
  expect_found(nearby, 0.9);
  EXPECT_LE(quantile(nearby.after_s, 0.9), quantile(anywhere.after_s, 0.9));
}

TEST(Kidnapped, IsFoundAmongNames) {
  expect_found(kidnap_often("names", [](RandomDraws& draws) {
    KidnapWorld world = lab(draws);
    world.names = true;
    return world;
  }));
}

TEST(Kidnapped, IsFoundAmongThingsThatAreAllAlike) {
  const Kidnappings all = kidnap_often("all alike, in the plane", [](RandomDraws& draws) { return lab(draws); });
  EXPECT_GE(all.found, seeds() * 85 / 100);
  EXPECT_LE(all.wrong, 1 + seeds() * 3 / 100);
}

}  // namespace
}  // namespace azimuth
