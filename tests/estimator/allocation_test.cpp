// The estimator thread does not allocate once the map has stopped growing.

#include <algorithm>
#include <gtest/gtest.h>
#include <ostream>
#include <string>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/simulated_drive.hpp"

namespace azimuth {
namespace {

struct Configuration {
  const char* name;
  Initialisation initialisation;
  bool identities;
};
std::ostream& operator<<(std::ostream& out, const Configuration& configuration) { return out << configuration.name; }

class EstimatorAllocation : public testing::TestWithParam<Configuration> {};

TEST_P(EstimatorAllocation, NoneInTheSecondAndThirdLap) {
  Scenario scenario = lab(1, 3);
  scenario.sensor.identities = GetParam().identities;
  World world = simulate(scenario);  // its sets give their storage to the stage
  const Rig rig = rig_of(scenario);
  EkfSettings settings;
  settings.initialisation = GetParam().initialisation;
  settings.max_landmarks = 24;  // without identities the map would keep growing slowly
  auto estimator = std::make_unique<EkfEstimator>(rig, settings);
  const JointState& state = estimator->filter().state();
  EstimatorStage stage(std::move(estimator), rig, StageSettings{});
  Estimate estimate, prediction;

  const Stamp warm = Stamp{std::chrono::seconds(75)};  // a lap takes 70 s
  std::size_t in_first_lap = 0, later = 0, reading = 0, steps = 0, most_at_once = 0;
  Index largest = 0;
  for (BearingSet& set : world.bearings) {
    const bool is_warm = set.stamp > warm;
    const std::size_t before = allocations();
    for (; reading < world.odometry.size() && world.odometry[reading].stamp < set.stamp; ++reading) {
      stage.add(world.odometry[reading]);
      while (stage.advance(estimate)) ++steps;
      stage.look_ahead(prediction);
    }
    stage.add(set);
    while (stage.advance(estimate)) ++steps;
    // Without identities, the state and the number of bearings in one update may grow at any time.
    const bool grew = state.extent() > largest || estimate.accepted.size() > most_at_once;
    largest = std::max(largest, state.extent());
    most_at_once = std::max(most_at_once, estimate.accepted.size());
    (is_warm && !grew ? later : in_first_lap) += allocations() - before;
  }
  EXPECT_GT(steps, 900u);
  EXPECT_GT(in_first_lap, 0u);  // the counter works
  EXPECT_EQ(later, 0u);
}

INSTANTIATE_TEST_SUITE_P(Configurations, EstimatorAllocation,
                         testing::Values(Configuration{"Delayed", Initialisation::delayed, true},
                                         Configuration{"Undelayed", Initialisation::undelayed, true},
                                         Configuration{"WithoutIdentities", Initialisation::undelayed, false}),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace azimuth
