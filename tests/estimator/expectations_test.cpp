// The bearings that the estimator expects of its map, between prediction and update.

#include <gtest/gtest.h>
#include <map>

#include "slam/geometry/angle.hpp"
#include "tests/support/simulated_drive.hpp"

namespace azimuth {
namespace {

/// The numbers of bearings with identities inside and outside their expected gates.
struct Gated {
  int inside = 0, outside = 0;
  double gate_sum_rad = 0.0;
};

Gated drive(const EkfSettings& settings) {
  const Scenario scenario = lab(3, 1);
  const World world = simulate(scenario);
  const Rig rig = rig_of(scenario);
  auto owned = std::make_unique<EkfEstimator>(rig, settings);
  const EkfEstimator& ekf = *owned;
  EstimatorStage stage(std::move(owned), rig, {});
  Gated gated;
  std::vector<ExpectedBearing> expected;
  stage.before_update([&](const BearingSet& set, const Estimator& estimator) {
    estimator.expect(expected);
    std::map<Identity, ExpectedBearing> by_name;
    for (const EkfEstimator::Landmark& landmark : ekf.landmarks())
      for (const ExpectedBearing& one : expected)
        if (one.landmark == landmark.id) by_name[landmark.identity] = one;
    for (const Bearing& bearing : set.bearings) {
      const auto found = by_name.find(bearing.identity);
      if (found == by_name.end()) continue;
      const double off_rad = std::abs(wrap(bearing.azimuth_rad - found->second.azimuth_rad));
      ++(off_rad <= found->second.gate_rad ? gated.inside : gated.outside);
      gated.gate_sum_rad += found->second.gate_rad;
    }
  });
  Estimate estimate;
  std::size_t next = 0;
  for (const OdometryReading& reading : world.odometry) {
    stage.add(reading);
    for (; next < world.bearings.size() && world.bearings[next].stamp <= reading.stamp; ++next) {
      BearingSet set = world.bearings[next];
      stage.add(set);
    }
    while (stage.advance(estimate)) {
    }
  }
  return gated;
}

TEST(Expectations, NamedBearingsLieInTheGateOfTheirLandmark) {
  EkfSettings settings;
  settings.gates.chi2 = 9.0;
  const Gated three_sigma = drive(settings);
  EXPECT_GT(three_sigma.inside, 500);
  EXPECT_LT(three_sigma.outside, 0.02 * three_sigma.inside) << "0.3 % of them if the filter knew its errors exactly";
}

TEST(Expectations, TheGateIsTheFiltersOwn) {
  EkfSettings narrow, ungated;
  narrow.gates.chi2 = 4.0;
  ungated.gates.chi2 = 0.0;
  const Gated two_sigma = drive(narrow), three_sigma = drive(ungated);
  EXPECT_GT(three_sigma.gate_sum_rad / (three_sigma.inside + three_sigma.outside),
            1.2 * two_sigma.gate_sum_rad / (two_sigma.inside + two_sigma.outside));
  EXPECT_GT(two_sigma.outside, 0.01 * two_sigma.inside) << "5 % of Gaussian errors are beyond two sigma";
}

TEST(Expectations, NothingIsExpectedOfAnEmptyMap) {
  std::vector<ExpectedBearing> expected(3);
  EkfEstimator(Rig{}, {}).expect(expected);
  EXPECT_TRUE(expected.empty());
}

}  // namespace
}  // namespace azimuth
