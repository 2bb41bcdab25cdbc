// The daemon on a robot whose camera sends images, in which the daemon finds the bearings.

#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <thread>

#include "tests/live/field_log.hpp"
#include "tests/live/live.hpp"
#include "tests/live/text.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

const std::vector<std::string> kMirror{"--images", "mirror", "--image-rate", "5", "--image-format", "yuyv"};

void replace_in(const std::filesystem::path& file, const std::string& what, const std::string& by) {
  std::ifstream in(file);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  text.replace(text.find(what), what.size(), by);
  std::ofstream(file) << text;
}

class Camera : public test::Live {
 protected:
  Camera() { rig_ = test::Robot::write_rig(folder(), kMirror); }
};

TEST_F(Camera, LandmarksFoundInImagesAreMapped) {
  test::Robot robot(folder(), kMirror);
  const auto daemon = recording_daemon();
  ASSERT_TRUE(daemon->has_odometry()) << daemon->standard_error();
  EXPECT_TRUE(daemon->has_landmarks(4)) << daemon->standard_error();
  std::this_thread::sleep_for(3s);
  ASSERT_EQ(daemon->stop(), 0);
  ASSERT_EQ(robot.end(), 0);

  const test::RecordedMessages published = test::published(test::only_session(records()));
  test::expect_at_true_place(published, robot.truth());
  const status_t& status = published.statuses.back();
  EXPECT_THAT(status.camera, HasSubstr("yuyv 1024x768"));
  EXPECT_GE(status.frames, status.steps);
  EXPECT_EQ(status.frames_unusable, 0);
  EXPECT_EQ(status.image_trouble, "");
  EXPECT_GT(status.detect_mean_us, 0.0);

  const test::FieldLog log(test::only_session(records()));
  EXPECT_TRUE(log.verification.passed()) << log.verification.text();
  EXPECT_GT(log.verification.recorded, 10U);
  EXPECT_THAT(daemon->standard_error(), HasSubstr(fmt::format("digest {:016x}", log.replayed.digest)));
}

/// The camera's image size differs from the rig's.
TEST_F(Camera, ImagesOfTheWrongSizeAreNamedAndEndNothing) {
  replace_in(rig_, "width_px = 1024", "width_px = 1022");
  test::Robot robot(folder(), kMirror);
  const auto daemon = recording_daemon();
  ASSERT_TRUE(daemon->has_odometry()) << daemon->standard_error();
  const std::string trouble(to_string(ImageTrouble::unreadable));
  EXPECT_TRUE(daemon->logs(trouble)) << daemon->standard_error();
  EXPECT_EQ(daemon->stop(), 0);
  const test::RecordedMessages published = test::published(test::only_session(records()));
  const status_t& status = published.statuses.back();
  EXPECT_EQ(status.image_trouble, trouble);
  EXPECT_GT(status.frames_unusable, 0);
  EXPECT_GT(published.poses.size(), 0U) << "odometry goes on";
}

}  // namespace
}  // namespace azimuth
