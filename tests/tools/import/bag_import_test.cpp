#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <span>
#include <sys/wait.h>

#include "drivers/camera/png.hpp"
#include "drivers/storage/run.hpp"
#include "slam/geometry/angle.hpp"
#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"
#include "tests/tools/import/bag_writer.hpp"

namespace azimuth::test {
namespace {

namespace fs = std::filesystem;

constexpr double kBegin_s = 1000.0;

std::string pixels(std::size_t count, int seed) {
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>((static_cast<int>(i) * 7 + seed) % 251);
  return bytes;
}

/// 10 s of odometry at 10 Hz, one image per second and a message with text.
std::vector<BagMessage> drive() {
  std::vector<BagMessage> messages;
  for (int i = 0; i < 100; ++i) {
    const double t = kBegin_s + 0.1 * i;
    messages.push_back({"/odom", kOdometryType, t, odometry_bytes(t, 0.05 * i, 0.0, 0.0, 1.0)});
    if (i % 10 == 0)
      messages.push_back({"/camera/image_raw", kImageType, t, image_bytes(t, 8, 6, "rgb8", 24, pixels(144, i))});
  }
  messages.push_back({"/chatter", kTextType, kBegin_s, RosBytes().text("hello").bytes()});
  return messages;
}

std::vector<BagMessage> without(std::vector<BagMessage> messages, const std::string& topic) {
  std::erase_if(messages, [&](const BagMessage& message) { return message.topic == topic; });
  return messages;
}

Run run_in(const std::string& path) {
  auto run = load_run(path, {.rig_file = one_lap() + "/rig.toml", .odometry_alone = true});
  EXPECT_TRUE(run) << text(run.error());
  return run ? *std::move(run) : Run{};
}

void expect_the_drive(const Run& run) {
  ASSERT_EQ(run.odometry.size(), 100u);
  EXPECT_EQ(run.odometry[37].stamp, stamp_from_us(1'003'700'000));
  EXPECT_NEAR(run.odometry[37].T_odom_body.x_m, 1.85, 1e-12);
  ASSERT_EQ(run.frames.size(), 10u);
  EXPECT_EQ(run.frames[3].stamp, stamp_from_us(1'003'000'000));
}

class Bags : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_write_bags()) GTEST_SKIP() << "librosbag-storage-dev was not installed";
  }
  std::string bag() const { return scratch_ / "drive.bag"; }
  std::string out() const { return scratch_ / "run"; }
  Outcome run_import(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"import", bag(), out()};
    words.insert(words.end(), more.begin(), more.end());
    return azimuth(words);
  }
  void expect_refusal(const std::string& sentence, const std::vector<std::string>& more = {}) const {
    const Outcome refused = run_import(more);
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find(sentence), std::string::npos) << refused.err;
    EXPECT_FALSE(fs::exists(out()));
  }

  ScratchFolder scratch_;
};

TEST_F(Bags, BecomeARunFolder) {
  for (const BagCompression compression : {BagCompression::none, BagCompression::bz2, BagCompression::lz4}) {
    write_bag(bag(), drive(), compression);
    const Outcome imported = run_import({"--force"});
    ASSERT_EQ(imported.code, 0) << imported.err;
    EXPECT_EQ(imported.err, "");
    const azimuth::Run run = run_in(out());
    expect_the_drive(run);
    PngDecoder png;
    const std::string file = file_bytes(out() + '/' + run.frames[3].file);
    const ImageView image = png.decode(std::as_bytes(std::span(file)), PixelFormat::rgb8);
    ASSERT_EQ(image.bytes.size(), 144u) << png.problem();
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(image.bytes.data()), 144), pixels(144, 30));
  }
}

TEST_F(Bags, BecomeALogToTheLastPixel) {
  write_bag(bag(), drive());
  const std::string log = scratch_ / "run.lcmlog";
  const Outcome imported = azimuth({"import", bag(), log, "--rig", one_lap() + "/rig.toml"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_FALSE(fs::exists(log + ".images"));
  const azimuth::Run run = run_in(log);
  expect_the_drive(run);
  ASSERT_TRUE(run.frames[3].part);
  EXPECT_EQ(run.frames[3].part->format, (FrameFormat{PixelFormat::rgb8, 8, 6, 24}));
  EXPECT_EQ(file_bytes(log).substr(run.frames[3].part->offset, 144), pixels(144, 30));
}

TEST_F(Bags, AreListedWithWhatWouldBeTaken) {
  write_bag(bag(), drive());
  const Outcome listed = azimuth({"import", bag()});
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_EQ(listed.out,
            "/camera/image_raw  sensor_msgs/Image       10 messages      0.00 to     9.00 s  taken as images\n"
            "/chatter           std_msgs/String          1 messages      0.00 to     0.00 s\n"
            "/odom              nav_msgs/Odometry      100 messages      0.00 to     9.90 s  taken as odometry\n"
            "next: azimuth import " +
                bag() + " OUT\n");
}

TEST_F(Bags, TellWhereTheCameraStands) {
  // GIVEN images of a camera whose frame hangs on a mast in the robot's frame
  std::vector<BagMessage> messages = without(drive(), "/camera/image_raw");
  for (int i = 0; i < 10; ++i) {
    RosBytes image;
    image.header(kBegin_s + i, "eye").u32(6).u32(8).text("rgb8").u8(0).u32(24).text(pixels(144, i));
    messages.push_back({"/camera/image_raw", kImageType, kBegin_s + i, image.bytes()});
  }
  const auto link = [](RosBytes& bytes, std::string_view parent, std::string_view child, double x_m, double qz,
                       double qw) {
    bytes.header(kBegin_s, parent).text(child).f64s({x_m, 0.0, 0.5, 0.0, 0.0, qz, qw});
  };
  RosBytes links;
  links.u32(2);
  link(links, "/base", "mast", 0.2, std::sin(kPi / 4.0), std::cos(kPi / 4.0));
  link(links, "mast", "eye", 0.1, 0.0, 1.0);
  messages.push_back({"/tf_static", kTransformsType, kBegin_s, links.bytes()});
  std::ranges::stable_sort(messages, {}, &BagMessage::recorded_s);
  write_bag(bag(), messages);

  // WHEN the bag is imported with a rig that has no camera position, and without a rig
  write_file(scratch_ / "rig.toml", "[camera]\nmodel = \"bearings\"\n");
  const Outcome with_rig = run_import({"--rig", scratch_ / "rig.toml"});
  ASSERT_EQ(with_rig.code, 0) << with_rig.err;
  EXPECT_NE(with_rig.out.find("eye in base at camera.position_m = [0.200, 0.100], 1.000 m up"), std::string::npos)
      << with_rig.out;
  EXPECT_NE(file_bytes(out() + "/rig.toml").find("position_m = [0.2000, 0.1000]"), std::string::npos);

  const Outcome without_rig = azimuth({"import", bag(), scratch_ / "other"});
  ASSERT_EQ(without_rig.code, 0) << without_rig.err;
  EXPECT_NE(without_rig.out.find("put that into the rig"), std::string::npos) << without_rig.out;
}

TEST_F(Bags, WithSeveralTopicsAskWhich) {
  std::vector<BagMessage> messages = drive();
  for (const BagMessage& message : drive()) {
    messages.push_back(message);
    messages.back().topic += "/second";
  }
  write_bag(bag(), messages);
  expect_refusal("has several topics of odometry: /odom, /odom/second; choose by --odometry TOPIC");
  expect_refusal("has several topics of images: /camera/image_raw, /camera/image_raw/second; choose by --images TOPIC");
  expect_refusal("has no topic /odm; did you mean /odom?", {"--odometry", "/odm", "--images", "/camera/image_raw"});
  expect_refusal("topic /chatter is of std_msgs/String, which --images TOPIC cannot use", {"--images", "/chatter"});
  const Outcome imported = run_import({"--odometry", "/odom/second", "--images", "/camera/image_raw"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  expect_the_drive(run_in(out()));
}

TEST_F(Bags, WithoutOdometryAreRefused) {
  write_bag(bag(), without(drive(), "/odom"));
  expect_refusal("has no odometry: no topic of nav_msgs/Odometry");
}

TEST_F(Bags, TakePosesForTruthOrOdometry) {
  std::vector<BagMessage> messages = drive();
  for (int i = 0; i < 20; ++i)
    messages.push_back({"/vicon", kPoseStampedType, kBegin_s + i,
                        RosBytes().header(kBegin_s + 0.5 * i).pose(1.0 * i, 2.0, 0.0, 1.0).bytes()});
  write_bag(bag(), messages);
  ASSERT_EQ(run_import({"--truth", "/vicon"}).code, 0);
  const azimuth::Run run = run_in(out());
  ASSERT_EQ(run.truth.size(), 20u);
  EXPECT_EQ(run.truth[3].stamp, stamp_from_us(1'001'500'000)) << "the header's, not when it was recorded";
  EXPECT_EQ(run.truth[3].T_world_body, (Pose2{3.0, 2.0, 0.0}));
  ASSERT_EQ(run_import({"--odometry", "/vicon", "--force"}).code, 0);
  EXPECT_EQ(run_in(out()).odometry.size(), 20u);
}

TEST_F(Bags, TakeJointsForOdometryOnceWheelsAreKnown) {
  std::vector<BagMessage> messages = without(drive(), "/odom");
  for (int i = 0; i < 20; ++i)
    messages.push_back({"/joints", kJointStateType, kBegin_s + i,
                        joints_bytes(kBegin_s + i, {{"right_wheel", 2.0 * i}, {"left_wheel", 2.0 * i}})});
  write_bag(bag(), messages);
  expect_refusal("sensor_msgs/JointState needs --track METRES and --wheel-radius METRES");
  const Outcome imported = run_import({"--track", "0.4", "--wheel-radius", "0.1"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_NEAR(run_in(out()).odometry.at(10).T_odom_body.x_m, 2.0, 1e-12);
}

TEST_F(Bags, KeepCompressedImagesAsTheyAre) {
  std::vector<BagMessage> messages = without(drive(), "/camera/image_raw");
  const std::string jpeg = "\xff\xd8\xff\xc0" + std::string("\x00\x0b\x08\x00\x06\x00\x08\x01\x11\x00\x00", 11) + "...";
  for (int i = 0; i < 5; ++i)
    messages.push_back(
        {"/camera/compressed", kCompressedImageType, kBegin_s + i, compressed_bytes(kBegin_s + i, "jpeg", jpeg)});
  messages.push_back(
      {"/camera/compressed", kCompressedImageType, kBegin_s + 9, compressed_bytes(kBegin_s + 9, "webp", "RIFF")});
  write_bag(bag(), messages);
  const Outcome imported = run_import();
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_NE(imported.out.find("1 images in formats that cannot be read"), std::string::npos) << imported.out;
  EXPECT_EQ(file_bytes(out() + "/frames/000004.jpg"), jpeg);
}

TEST_F(Bags, OfBayerPatternsFitALogOnly) {
  std::vector<BagMessage> messages = without(drive(), "/camera/image_raw");
  messages.push_back({"/camera", kImageType, kBegin_s, image_bytes(kBegin_s, 8, 6, "bayer_rggb8", 8, pixels(48, 1))});
  write_bag(bag(), messages);
  expect_refusal("a run folder cannot hold bayer_rggb8 images without loss; an LCM log can: let OUT end in .lcmlog");
  const std::string log = scratch_ / "run.lcmlog";
  ASSERT_EQ(azimuth({"import", bag(), log, "--rig", one_lap() + "/rig.toml"}).code, 0);
  EXPECT_EQ(run_in(log).frames.at(0).part->format.pixels, PixelFormat::bayer_rggb8);
}

TEST_F(Bags, ThatAreRefusedAtALaterImageLeaveNothingBehind) {
  std::vector<BagMessage> messages = drive();
  messages.push_back({"/camera/image_raw", kImageType, kBegin_s + 50,
                      image_bytes(kBegin_s + 50, 8, 6, "bayer_rggb8", 8, pixels(48, 1))});
  write_bag(bag(), messages);
  expect_refusal("a run folder cannot hold bayer_rggb8 images without loss");
}

TEST_F(Bags, WhoseOdometerBeginsAnewAreBridged) {
  std::vector<BagMessage> messages = without(drive(), "/odom");
  for (int i = 0; i < 100; ++i) {
    const double t = kBegin_s + 0.1 * i, x_m = i < 50 ? 10.0 + 0.05 * i : 0.05 * (i - 50);
    messages.push_back({"/odom", kOdometryType, t, odometry_bytes(t, x_m, 0.0, 0.0, 1.0)});
  }
  write_bag(bag(), messages);
  const Outcome imported = run_import();
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_NE(imported.err.find("odometry begins anew 5.0 s after its first reading"), std::string::npos) << imported.err;
  const azimuth::Run run = run_in(out());
  EXPECT_EQ(run.frames.size(), 10u);
  ASSERT_EQ(run.odometry.size(), 100u);
  EXPECT_EQ(run.odometry[49].origin, 0u);
  EXPECT_EQ(run.odometry[50].origin, 1u);
  EXPECT_GT(run.odometry[50].sigma_gap_m, 0.04);
}

TEST_F(Bags, OfWheelsThatWrapAreUnwrapped) {
  std::vector<BagMessage> messages = without(drive(), "/odom");
  for (int i = 0; i < 100; ++i) {
    const double t = kBegin_s + 0.1 * i, angle_rad = wrap(0.3 * i);
    messages.push_back(
        {"/joints", kJointStateType, t, joints_bytes(t, {{"right_wheel", angle_rad}, {"left_wheel", angle_rad}})});
  }
  write_bag(bag(), messages);
  const Outcome imported = run_import({"--track", "0.4", "--wheel-radius", "0.1"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_NE(imported.out.find("note: the left wheel's counter wraps at a full turn: unwrapped 5 times"),
            std::string::npos)
      << imported.out;
  EXPECT_NEAR(run_in(out()).odometry.back().T_odom_body.x_m, 2.97, 1e-9);
}

TEST_F(Bags, CountWhatCannotBeUsed) {
  std::vector<BagMessage> messages = drive();
  messages.push_back({"/odom", kOdometryType, kBegin_s + 20, "short"});
  messages.push_back({"/odom", kOdometryType, kBegin_s + 21, odometry_bytes(kBegin_s + 21, 0, 0, 0, 0)});
  messages.push_back({"/odom", kOdometryType, kBegin_s + 22, odometry_bytes(kBegin_s + 1, 0, 0, 0, 1)});
  write_bag(bag(), messages);
  const Outcome imported = run_import();
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_NE(imported.out.find("1 odometry readings not in order"), std::string::npos) << imported.out;
  EXPECT_NE(imported.out.find("2 malformed messages"), std::string::npos) << imported.out;
  expect_the_drive(run_in(out()));
}

TEST_F(Bags, CutAnywhereAreReadAsFarAsTheyGo) {
  for (const BagCompression compression : {BagCompression::none, BagCompression::bz2, BagCompression::lz4}) {
    write_bag(bag(), drive(), compression);
    const std::string whole = file_bytes(bag());
    std::size_t readings = 0;
    for (std::size_t cut = 1; cut <= 16; ++cut) {
      write_file(bag(), whole.substr(0, whole.size() * cut / 16 - (cut == 16 ? 1 : 0)));
      const Outcome imported = run_import({"--force"});
      if (imported.code != 0) {
        EXPECT_EQ(readings, 0u) << imported.err;
        continue;
      }
      const std::size_t more = run_in(out()).odometry.size();
      EXPECT_GE(more, readings);
      readings = more;
    }
    EXPECT_EQ(readings, 100u) << "the index at the end is not needed";
  }
}

TEST_F(Bags, CutShortSayHowMuchIsLost) {
  write_bag(bag(), drive());
  const std::string whole = file_bytes(bag());
  write_file(bag(), whole.substr(0, whole.size() / 2 + 3));
  const Outcome imported = run_import();
  EXPECT_EQ(imported.code, 0) << imported.err;
  EXPECT_NE(imported.err.find("damaged bytes: cut short, or not closed? All else was read"), std::string::npos)
      << imported.err;
}

TEST_F(Bags, ThatAreNoneAreRefused) {
  write_file(bag(), "");
  expect_refusal("is not a bag");
  write_file(bag(), "t_s,x_m\n");
  expect_refusal("is not a bag");
  write_file(bag(), "#ROSBAG V1.2\n");
  expect_refusal("is a bag of a format before 2.0, which is not read");
  write_file(bag(), "#ROSBAG V2.0\n");
  expect_refusal("holds no message that can be read");
  write_file(bag(), "#ROSBAG V2.0\n and nonsense");
  expect_refusal("holds no message that can be read (13 damaged bytes)");
}

TEST_F(Bags, DamagedInOnePartLoseNoOther) {
  write_bag(bag(), drive(), BagCompression::bz2);
  std::string bytes = file_bytes(bag());
  const std::size_t chunk = bytes.find("BZh", bytes.size() / 3);
  ASSERT_NE(chunk, std::string::npos);
  for (std::size_t i = 20; i < 60; ++i) bytes[chunk + i] = 'x';
  write_file(bag(), bytes);
  const Outcome imported = run_import();
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_NE(imported.err.find("1 damaged chunks"), std::string::npos) << imported.err;
  const std::size_t readings = run_in(out()).odometry.size();
  EXPECT_GT(readings, 50u);
  EXPECT_LT(readings, 100u);
}

TEST_F(Bags, TakeNoColumns) {
  write_bag(bag(), drive());
  expect_refusal("is a bag, of which topics are taken", {"--columns", "t_s=t"});
}

TEST_F(Bags, OfPythonAreReadAsWell) {
  const std::string writer = (source_folder() / "tests/tools/import/python_bag.py").string();
  for (const std::string compression : {"none", "bz2", "lz4"}) {
    const int status = std::system(("/usr/bin/python3 -B '" + writer + "' '" + bag() + "' " + compression).c_str());
    if (WIFEXITED(status) && WEXITSTATUS(status) == 77) GTEST_SKIP() << "python3-rosbag is not installed";
    ASSERT_EQ(status, 0);
    const Outcome imported = run_import({"--odometry", "/pose", "--force"});
    ASSERT_EQ(imported.code, 0) << imported.err;
    const azimuth::Run run = run_in(out());
    EXPECT_EQ(run.odometry.size(), 50u);
    EXPECT_NEAR(run.odometry.at(20).T_odom_body.x_m, 1.0, 1e-12);
    EXPECT_EQ(run.odometry.at(20).stamp, stamp_from_us(1'002'000'000));
    EXPECT_EQ(run.frames.size(), 5u);
  }
}

}  // namespace
}  // namespace azimuth::test
