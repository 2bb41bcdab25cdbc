// Makes a map from a recording of another program without a rig and without code. Each format takes three commands:
// import, calibrate and replay.

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

#include "drivers/camera/run_images.hpp"
#include "drivers/storage/event_log.hpp"
#include "drivers/storage/run.hpp"
#include "drivers/wire/image_message.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"
#include "tests/tools/import/bag_writer.hpp"

namespace azimuth::test {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kTimeOfDay_s = 1'700'000'000;

class FirstMap : public testing::Test {
 protected:
  void SetUp() override {
    FileResult<azimuth::Run> run = load_run(source_folder() / "runs/mirror");
    ASSERT_TRUE(run) << text(run.error());
    drive_ = *std::move(run);
    std::ostringstream truth;
    truth.precision(16);
    truth << "t_s,x_m,y_m,heading_rad\n";
    for (const TruthPose& pose : drive_.truth) {
      const Pose2& p = pose.T_world_body;
      truth << static_cast<double>(time_us(pose.stamp)) / 1e6 << ',' << p.x_m << ',' << p.y_m << ',' << p.heading_rad
            << '\n';
    }
    write_file(scratch_ / "truth.csv", truth.str());
  }

  /// The stamp as time of day, which recordings have; the run begins at 0.
  static std::int64_t time_us(Stamp stamp) { return kTimeOfDay_s * 1'000'000 + to_us(stamp); }
  static double time_s(Stamp stamp) { return static_cast<double>(kTimeOfDay_s) + to_seconds(stamp); }
  std::string jpeg(const FrameFile& frame) const { return file_bytes(drive_.folder / frame.file); }

  /// Writes an LCM log with bot_core poses on WHEELS, bot_core images on CAM and a channel BATTERY of unknown type.
  void write_log(bool compressed) const {
    EventLogWriter log = *EventLogWriter::create(scratch_ / "drive.lcm");
    std::vector<std::byte> data;
    for (const OdometryReading& reading : drive_.odometry) {
      const Pose2& p = reading.T_odom_body;
      pose_t pose{};
      pose.utime = time_us(reading.stamp);
      pose.pos[0] = p.x_m, pose.pos[1] = p.y_m;
      pose.orientation[0] = std::cos(p.heading_rad / 2.0), pose.orientation[3] = std::sin(p.heading_rad / 2.0);
      encode(pose, data);
      ASSERT_FALSE(log.write(pose.utime, "WHEELS", data));
    }
    RunImages images(drive_);
    for (std::size_t i = 0; i < images.count(); ++i) {
      image_t message{};
      const ImageView image = compressed ? images.recorded(i) : images.pixels(i, PixelFormat::bgr8);
      fill_message(image, stamp_from_us(time_us(drive_.frames[i].stamp)), message);
      encode(message, data);
      ASSERT_FALSE(log.write(message.utime, "CAM", data));
    }
    ASSERT_FALSE(log.write(time_us(drive_.odometry.back().stamp), "BATTERY", std::vector<std::byte>(12)));
  }

  /// Runs the second and the third command and expects a map.
  void expect_a_map() const {
    const std::string run = scratch_ / "run", rig = run + "/rig.toml", map = scratch_ / "map.png";
    const Outcome calibrated = azimuth({"calibrate", "mirror", run, "--out", rig});
    ASSERT_EQ(calibrated.code, 0) << calibrated.err;
    EXPECT_NE(calibrated.out.find("next: azimuth replay " + run + " --plot map.png"), std::string::npos)
        << calibrated.out;
    const Outcome replayed = azimuth({"replay", run, "--plot", map, "--truth", scratch_ / "truth.csv"});
    ASSERT_EQ(replayed.code, 0) << replayed.err;
    EXPECT_NE(replayed.out.find("tracking 36.0 s (100.0 %)"), std::string::npos) << replayed.out;
    EXPECT_GT(file_bytes(map).size(), 1000u);
  }

  static void expect_next_is_the_rig(const Outcome& outcome) {
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("azimuth calibrate "), std::string::npos) << outcome.out;
  }

  ScratchFolder scratch_;
  azimuth::Run drive_;
};

TEST_F(FirstMap, OfATableAndAFolderOfStampedImages) {
  std::ostringstream table;
  table.precision(16);
  table << "timestamp;x;y;yaw\n";
  for (const OdometryReading& reading : drive_.odometry) {
    const Pose2& p = reading.T_odom_body;
    table << static_cast<double>(time_us(reading.stamp)) / 1e6 << ';' << p.x_m << ';' << p.y_m << ';'
          << p.heading_rad * 180.0 / std::numbers::pi << '\n';
  }
  write_file(scratch_ / "odometry.csv", table.str());
  fs::create_directory(scratch_ / "left");
  for (const FrameFile& frame : drive_.frames)
    write_file((scratch_ / "left/") + std::to_string(1000 * time_us(frame.stamp)) + ".jpg", jpeg(frame));
  expect_next_is_the_rig(azimuth({"import", scratch_ / "odometry.csv", scratch_ / "run", "--columns",
                                  "t_s=timestamp,x_m=x,y_m=y,heading_rad=yaw[deg]", "--images", scratch_ / "left",
                                  "--stamps", "name[ns]"}));
  expect_a_map();
}

TEST_F(FirstMap, OfABag) {
  if (!can_write_bags()) GTEST_SKIP() << "librosbag-storage-dev was not installed";
  std::vector<BagMessage> messages;
  for (const OdometryReading& reading : drive_.odometry) {
    const double t_s = time_s(reading.stamp);
    const Pose2& p = reading.T_odom_body;
    messages.push_back(
        {"/odom", kOdometryType, t_s,
         odometry_bytes(t_s, p.x_m, p.y_m, std::sin(p.heading_rad / 2.0), std::cos(p.heading_rad / 2.0))});
  }
  for (const FrameFile& frame : drive_.frames) {
    const double t_s = time_s(frame.stamp);
    messages.push_back({"/camera/compressed", kCompressedImageType, t_s, compressed_bytes(t_s, "jpeg", jpeg(frame))});
  }
  write_bag(scratch_ / "drive.bag", messages, BagCompression::bz2);
  expect_next_is_the_rig(azimuth({"import", scratch_ / "drive.bag", scratch_ / "run"}));
  expect_a_map();
}

TEST_F(FirstMap, OfALogOfOthersWithoutARig) {
  write_log(true);
  const std::string log = scratch_ / "drive.lcm", run = scratch_ / "run";
  const std::vector<std::string> convert{"import", log, run, "--odometry-channel", "WHEELS"};
  const Outcome blind = azimuth(convert);
  EXPECT_NE(blind.out.find("events on foreign channels; perhaps --image-channel CAM\n"), std::string::npos)
      << blind.out << blind.err;
  fs::remove_all(run);
  const Outcome replayed = azimuth({"replay", log, "--odometry-channel", "WHEELS", "--image-channel", "CAM"});
  EXPECT_EQ(replayed.code, 2);
  EXPECT_NE(replayed.err.find("azimuth import makes a run folder without"), std::string::npos) << replayed.err;
  expect_next_is_the_rig(azimuth({"import", log, run, "--odometry-channel", "WHEELS", "--image-channel", "CAM"}));
  EXPECT_FALSE(fs::exists(run + "/rig.toml"));
  EXPECT_EQ(file_bytes(run + "/frames/000007.jpg"), jpeg(drive_.frames[7]));
  expect_a_map();
}

TEST_F(FirstMap, OfALogWhoseImagesAreNotCompressed) {
  write_log(false);
  expect_next_is_the_rig(azimuth(
      {"import", scratch_ / "drive.lcm", scratch_ / "run", "--odometry-channel", "WHEELS", "--image-channel", "CAM"}));
  EXPECT_TRUE(fs::exists(scratch_ / "run/frames/000007.png"));
  expect_a_map();
}

}  // namespace
}  // namespace azimuth::test
