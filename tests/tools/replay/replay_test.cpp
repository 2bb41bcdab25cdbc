#include "tools/replay/replay.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "slam/planar/make_ekf_estimator.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

/// Dead reckoning that counts its calls.
struct Calls {
  std::size_t predictions = 0, updates = 0, bearings = 0;
};

class Odometer final : public Estimator {
 public:
  explicit Odometer(Calls& calls) : calls_(calls) {}
  void predict(const Motion& motion) override {
    T_map_body_ = T_map_body_ * motion.T_start_end;
    ++calls_.predictions;
  }
  void update(const BearingSet& observations) override {
    ++calls_.updates;
    calls_.bearings += observations.bearings.size();
  }
  void estimate(Estimate& out) const override { out.T_map_body = T_map_body_; }
  void look_ahead(const Motion& motion, Estimate& out) const override {
    out.T_map_body = T_map_body_ * motion.T_start_end;
  }

 private:
  Calls& calls_;
  Pose2 T_map_body_;
};

std::size_t bearings_in(const Run& run) {
  std::size_t count = 0;
  for (const BearingSet& set : run.bearings) count += set.bearings.size();
  return count;
}

TEST(Replay, StepsOnceForEverySet) {
  const azimuth::Run run = simulated_run(lab(1, 1));
  Calls calls;
  const ReplayResult result = replay(run, Rig{}, std::make_unique<Odometer>(calls), StageSettings{});
  EXPECT_EQ(calls.updates, run.bearings.size());
  EXPECT_EQ(calls.predictions, run.bearings.size());
  EXPECT_EQ(calls.bearings, bearings_in(run));
  ASSERT_EQ(result.estimates.size(), run.bearings.size());
  EXPECT_EQ(result.times.update_us.size(), run.bearings.size());
  EXPECT_EQ(result.times.step_us.size(), run.bearings.size());
  for (std::size_t i = 0; i < run.bearings.size(); ++i) EXPECT_EQ(result.estimates[i].stamp, run.bearings[i].stamp);
  EXPECT_EQ(result.last.input.bearings_without_odometry, 0u);
}

TEST(Replay, DeadReckoningEndsWhereOdometryDoes) {
  const azimuth::Run run = simulated_run(lab(2, 1));
  Calls calls;
  const ReplayResult result = replay(run, Rig{}, std::make_unique<Odometer>(calls), StageSettings{});
  const Pose2 T_map_odom = result.estimates.front().T_map_body * inverse(result.estimates.front().T_odom_body);
  const Pose2 expected = T_map_odom * result.estimates.back().T_odom_body;
  EXPECT_NEAR((expected.position() - result.estimates.back().T_map_body.position()).norm(), 0.0, 1e-9);
}

TEST(Replay, ReportsProgressToTheEnd) {
  const azimuth::Run run = simulated_run(coloured_lab(1));
  Calls calls;
  std::vector<std::size_t> done;
  replay(run, Rig{}, std::make_unique<Odometer>(calls), StageSettings{}, [&](std::size_t now, std::size_t all) {
    EXPECT_EQ(all, run.bearings.size());
    done.push_back(now);
  });
  ASSERT_EQ(done.size(), run.bearings.size());
  EXPECT_EQ(done.back(), run.bearings.size());
}

TEST(Replay, OfARunWithoutBearingsIsEmpty) {
  azimuth::Run run = simulated_run(coloured_lab(1));
  run.bearings.clear();
  Calls calls;
  EXPECT_TRUE(replay(run, Rig{}, std::make_unique<Odometer>(calls), StageSettings{}).estimates.empty());
}

TEST(Replay, GivesTheSameBitsEveryTime) {
  Rig rig;
  rig.camera.identities = true;
  const azimuth::Run run = simulated_run(lab(3, 1));
  const ReplayResult first = replay(run, rig, make_ekf_estimator(rig, EkfSettings{}), StageSettings{});
  const ReplayResult second = replay(run, rig, make_ekf_estimator(rig, EkfSettings{}), StageSettings{});
  EXPECT_EQ(first.digest, second.digest);
  const ReplayResult other =
      replay(simulated_run(lab(4, 1)), rig, make_ekf_estimator(rig, EkfSettings{}), StageSettings{});
  EXPECT_NE(first.digest, other.digest);
}

}  // namespace
}  // namespace azimuth
