// The estimated path on its way from the estimator to LCM while the pipeline runs.

#include <gtest/gtest.h>
#include <mutex>
#include <vector>

#include "daemon/pipeline/pipeline.hpp"
#include "drivers/wire/channels.hpp"
#include "slam/hindsight/make_smoother_estimator.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/daemon/quiet.hpp"
#include "tests/daemon/small_run.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

Rig named_rig() {
  Rig rig;
  rig.camera.identities = true;
  rig.camera.sigma_bearing_rad = 0.02;
  return rig;
}

/// Collects the path messages that the publisher sends on its own thread.
class Paths {
 public:
  Publisher publisher() {
    Publisher publisher(quiet());
    publisher.listen([this](std::string_view name, std::span<const std::byte> data, Stamp /*utime*/) {
      if (name != channel::kPath) return;
      const std::lock_guard lock(mutex_);
      path_t& path = paths_.emplace_back();
      EXPECT_EQ(path.decode(data.data(), 0, static_cast<int>(data.size())), static_cast<int>(data.size()));
    });
    return publisher;
  }
  std::vector<path_t> taken() {
    const std::lock_guard lock(mutex_);
    return paths_;
  }

 private:
  std::mutex mutex_;
  std::vector<path_t> paths_;
};

std::vector<path_t> paths_of(std::unique_ptr<Estimator> estimator, double speed, double duration_s) {
  Paths paths;
  Doorbell bell;
  Pipeline pipeline({.sources = test::played(test::small_recording(duration_s), speed),
                     .estimator = EstimatorStage(std::move(estimator), named_rig(), StageSettings{}),
                     .publisher = paths.publisher()},
                    ThreadSettings{}, bell);
  pipeline.start();
  for (int i = 0; i < 300 && !pipeline.finished(); ++i) bell.wait(100ms);
  EXPECT_TRUE(pipeline.finished());
  pipeline.stop();
  return paths.taken();
}

TEST(PipelinePath, IsSentAtTheEndAsItIsKnownThen) {
  const std::vector<path_t> paths = paths_of(make_smoother_estimator(named_rig(), {}), 0.0, 60.0);
  ASSERT_FALSE(paths.empty());
  EstimatorStage alone(make_smoother_estimator(named_rig(), {}), named_rig(), {});
  const Recording recording = test::small_recording(60.0);
  std::vector<PathPose> path;
  {
    RunPlayer player(recording, 0.0);
    Estimate estimate;
    for (; !player.over(); player.advance()) {
      const RunPlayer::Sample sample = player.peek();
      if (sample.odometry) alone.add(*sample.odometry);
      if (sample.bearings) alone.add(*sample.bearings);
      while (alone.advance(estimate)) continue;
    }
    alone.finish();
    while (alone.advance(estimate)) continue;
    ASSERT_TRUE(alone.estimator().write_path(path));
  }
  const path_t& last = paths.back();
  ASSERT_EQ(static_cast<std::size_t>(last.n), path.size());
  EXPECT_GT(path.size(), 50U) << "two keyframes a second";
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(last.poses[i].utime, to_us(path[i].stamp));
    EXPECT_EQ(last.poses[i].x_m, path[i].T_map_body.x_m);
    EXPECT_EQ(last.poses[i].heading_rad, path[i].T_map_body.heading_rad);
  }
}

TEST(PipelinePath, IsAskedForWhileTheRobotDrives) {
  const std::vector<path_t> paths = paths_of(make_smoother_estimator(named_rig(), {}), 8.0, 60.0);
  ASSERT_FALSE(paths.empty());
  EXPECT_LT(paths.front().utime, 55'000'000) << "not only at the end";
}

TEST(PipelinePath, AFilterHasNone) { EXPECT_TRUE(paths_of(make_ekf_estimator(named_rig(), {}), 0.0, 20.0).empty()); }

}  // namespace
}  // namespace azimuth
