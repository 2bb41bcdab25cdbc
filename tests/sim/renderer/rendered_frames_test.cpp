// Images from the simulator to a client of the camera link.

#include "sim/azimuth_sim/rendered_frames.hpp"

#include <gmock/gmock.h>

#include "drivers/camera/shared_camera.hpp"
#include "settings/rig.hpp"
#include "sim/azimuth_sim/camera_link.hpp"
#include "sim/renderer/renderer.hpp"
#include "tests/drivers/camera/link_fixture.hpp"

namespace azimuth::sim {
namespace {

const ImageSettings kGrayMirror{.pixels = PixelFormat::gray8, .rate_hz = 10.0, .noise = 0.0};

class RenderedFramesLink : public test::CameraLink {
 protected:
  RenderedFramesLink() : clock_(PacedClock::Monotonic::time_point{}, Duration{}, 1.0), camera_(path()) {
    FileResult<sim::CameraLink> link = sim::CameraLink::listen(path(), make_frames(scenario_, kGrayMirror));
    if (!link) throw std::runtime_error(text(link.error()));
    link_.emplace(*std::move(link));
  }
  void meet() {
    camera_.turn(now());
    link_->turn();
    camera_.turn(now());
  }
  void take_image(Stamp stamp, const Pose2& pose) {
    SimulationOutput output;
    output.frames.push_back({stamp, pose});
    link_->send(output, clock_);
  }

  Scenario scenario_ = lab(1, 1);
  PacedClock clock_;
  std::optional<sim::CameraLink> link_;
  SharedCamera camera_;
};

TEST_F(RenderedFramesLink, ImageIsThatOfThePoseAtItsStamp) {
  meet();
  const Pose2 pose{3.0, 2.2, 0.5};
  take_image(stamp_from_us(123'000), pose);
  int turns = 0;
  for (; link_->busy(); ++turns) link_->turn();
  EXPECT_GT(turns, 10) << "in short steps";
  camera_.turn(now());
  Frame frame;
  ASSERT_TRUE(camera_.take(frame));
  EXPECT_EQ(to_us(frame.stamp), 123'000);
  EXPECT_EQ(frame.format(), packed_format(PixelFormat::gray8, 1024, 768));

  RenderedFrames again(scenario_, kGrayMirror);
  std::vector<std::byte> expected(again.format().bytes());
  again.begin(pose);
  while (!again.step(expected)) {
  }
  EXPECT_TRUE(std::ranges::equal(frame.bytes(), expected));
}

TEST_F(RenderedFramesLink, ImageDueWhileAnotherIsMadeIsSkipped) {
  meet();
  take_image(stamp_from_us(1000), {3.0, 2.2, 0.5});
  take_image(stamp_from_us(2000), {3.1, 2.2, 0.5});
  while (link_->busy()) link_->turn();
  take_image(stamp_from_us(3000), {3.2, 2.2, 0.5});
  while (link_->busy()) link_->turn();
  camera_.turn(now());
  Frame frame;
  ASSERT_TRUE(camera_.take(frame));
  EXPECT_EQ(to_us(frame.stamp), 1000);
  ASSERT_TRUE(camera_.take(frame));
  EXPECT_EQ(to_us(frame.stamp), 3000);
  EXPECT_EQ(camera_.state().frames_missing, 1U);
}

TEST_F(RenderedFramesLink, NobodyThereNothingMade) {
  take_image(stamp_from_us(1000), {3.0, 2.2, 0.5});
  EXPECT_FALSE(link_->busy());
  meet();
  EXPECT_TRUE(camera_.state().connected);
}

TEST_F(RenderedFramesLink, ClientThatLeavesDoesNotStopTheCamera) {
  {
    SharedCamera first(path());
    first.turn(now());
    link_->turn();
    take_image(stamp_from_us(1000), {3.0, 2.2, 0.5});
    ASSERT_TRUE(link_->busy());
  }
  while (link_->busy()) link_->turn();
  meet();
  take_image(stamp_from_us(2000), {3.0, 2.2, 0.5});
  while (link_->busy()) link_->turn();
  camera_.turn(now());
  Frame frame;
  ASSERT_TRUE(camera_.take(frame));
  EXPECT_EQ(to_us(frame.stamp), 2000);
}

TEST(ImageRig, IsAWholeRigWithTheScenariosOdometry) {
  const Scenario scenario = lab(1, 1);
  const FileResult<Rig> rig = read_rig(image_rig_toml(scenario, {.camera = "fisheye"}), "rig.toml");
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(rig->front_end, FrontEnd::lamps);
  EXPECT_EQ(rig->odometry.lambda_drift_rad2_per_m, scenario.odometer.lambda_drift_rad2_per_m);
  std::string problem;
  EXPECT_TRUE(render_camera_of(rig->camera, problem)) << problem;
}

TEST(MakeFrames, NoneWhenNoneAreWanted) { EXPECT_EQ(make_frames(lab(1, 1), std::nullopt), nullptr); }

}  // namespace
}  // namespace azimuth::sim
