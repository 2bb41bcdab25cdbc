#include "slam/fastslam/particles.hpp"

#include <array>
#include <gtest/gtest.h>
#include <numeric>

#include "slam/geometry/random.hpp"

namespace azimuth {
namespace {

TEST(LowVariance, CopiesAreProportionalToWithinOne) {
  RandomNumbers<Xoshiro> random(Xoshiro(4));
  constexpr std::size_t kCount = 50;
  for (int trial = 0; trial < 200; ++trial) {
    std::array<double, kCount> log_weights{}, weights{};
    for (double& weight : log_weights) weight = -700.0 + 3.0 * random.normal();
    const double effective = normalise(log_weights, weights);
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0, 1e-12);
    EXPECT_TRUE(effective >= 1.0 && effective <= kCount);
    std::array<std::size_t, kCount> source{}, copies{};
    low_variance(weights, random.uniform() / kCount, source);
    for (const std::size_t from : source) ++copies[from];
    for (std::size_t k = 0; k < kCount; ++k)
      EXPECT_LT(std::abs(static_cast<double>(copies[k]) - kCount * weights[k]), 1.0 + 1e-9);
  }
}

/// Each particle marks its map, its candidates and its path, so that copies reveal their ancestor.
TEST(Particles, ResamplingCopiesEverything) {
  constexpr std::size_t kCount = 6;
  Particles particles(kCount, 4, 3);
  for (std::size_t k = 0; k < kCount; ++k) {
    const auto mark = static_cast<double>(k);
    particles[k].T_map_body.x_m = mark;
    for (std::size_t n = 0; n <= k % 3; ++n)
      particles.add_landmark(k, {mark, 0.0, 0.0}, {mark}, {.id = static_cast<int>(k)});
    LampCandidate& candidate = particles.add_candidate(k);
    candidate.id = static_cast<int>(k);
    candidate.sightings[0] = {.step = 600, .in_step = 0};
    for (std::int64_t step = 600; step <= 610; ++step) particles.path(k, step).from.x_m = mark;
  }
  const std::array<std::size_t, kCount> source{1, 1, 1, 4, 5, 5};
  particles.resample(source, 610);
  std::array<int, kCount> copies{};
  for (std::size_t k = 0; k < kCount; ++k) {
    const auto from = static_cast<std::size_t>(particles[k].T_map_body.x_m);
    ++copies[from];
    EXPECT_EQ(particles[k].landmarks, from % 3 + 1);
    for (const LampInfo& info : particles.infos(k)) EXPECT_EQ(info.id, static_cast<int>(from));
    for (const Symmetric3& covariance : particles.covariances(k)) EXPECT_EQ(covariance.xx, static_cast<double>(from));
    ASSERT_EQ(particles.candidates(k).size(), 1u);
    EXPECT_EQ(particles.candidates(k)[0].id, static_cast<int>(from));
    for (std::int64_t step = 600; step <= 610; ++step)
      EXPECT_EQ(particles.path(k, step).from.x_m, static_cast<double>(from));
  }
  EXPECT_EQ(copies, (std::array<int, kCount>{0, 3, 0, 0, 1, 2}));
  EXPECT_EQ(particles[1].T_map_body.x_m, 1.0) << "survivors stay where they are";
  EXPECT_EQ(particles[4].T_map_body.x_m, 4.0);
  EXPECT_EQ(particles[5].T_map_body.x_m, 5.0);
}

}  // namespace
}  // namespace azimuth
