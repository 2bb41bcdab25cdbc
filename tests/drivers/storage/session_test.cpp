#include "drivers/storage/session.hpp"

#include <array>
#include <gmock/gmock.h>

#include "drivers/storage/event_log.hpp"
#include "drivers/storage/frame_reader.hpp"
#include "drivers/storage/recorded_outputs.hpp"
#include "drivers/storage/run.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/image_message.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/drivers/storage/samples.hpp"

namespace azimuth {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::int64_t kFirstReading_us = 1'000'000;

/// Writes segments like the daemon: mark and documents first, then one reading and one bearing set per call.
class SegmentText {
 public:
  SegmentText(const std::filesystem::path& file, const SegmentMark& mark, const std::string& prefix = "")
      : log_(*EventLogWriter::create(file)), prefix_(prefix) {
    document(kSegmentDocument, to_text(mark));
    document("rig.toml", "x = 1\n");
    document(kConfigurationDocument, "estimator = \"ekf\"\n");
    document(kVersionDocument, "azimuthd 1.2.3\n");
  }
  SegmentText& samples(std::int64_t number) {
    const Stamp stamp = stamp_from_us(kFirstReading_us + number);
    write(channel::kOdometry, to_message(OdometryReading{.stamp = stamp, .T_odom_body = {0.5, 0.0, 0.0}}));
    write(channel::kBearings, to_message(BearingSet{stamp, 0, {{}}}));
    return *this;
  }
  SegmentText& pose(std::int64_t number, bool predicted) {
    pose_cov_t message{};
    message.utime = number;
    message.step = number;
    message.x_m = 0.1 + static_cast<double>(number);
    message.heading_rad = 7.0;  // outside [-pi, pi); must be kept unchanged
    message.covariance[8] = 0.3;
    message.odom_y_m = -0.7;
    message.predicted = predicted ? 1 : 0;
    write(channel::kPose, message);
    return *this;
  }
  void document(const char* name, const std::string& text) {
    write(channel::kDocument, to_message(name, text, Stamp{}));
  }
  void raw(std::string_view channel, Bytes data) { EXPECT_FALSE(log_.write(0, prefix_ + std::string(channel), data)); }

 private:
  template <class Message>
  void write(std::string_view channel, const Message& message) {
    std::vector<std::byte> data;
    encode(message, data);
    raw(channel, data);
  }
  EventLogWriter log_;
  std::string prefix_;
};

std::vector<std::int64_t> numbers(const std::vector<OdometryReading>& readings) {
  std::vector<std::int64_t> out;
  for (const OdometryReading& reading : readings) out.push_back(to_us(reading.stamp) - kFirstReading_us);
  return out;
}

TEST(Session, SegmentNamesAreTheirNumbers) {
  EXPECT_EQ(segment_name(0), "000.lcm");
  EXPECT_EQ(segment_name(42), "042.lcm");
  EXPECT_EQ(segment_name(1234), "1234.lcm");
  for (const std::uint64_t number : {0, 7, 999, 1000, 123456}) {
    EXPECT_EQ(segment_number(segment_name(number)), number);
  }
  for (const char* name : {"", "0.lcm", "0000.lcm", "000.log", "x00.lcm", "000.lcm~", "-01.lcm", "+01.lcm",
                           "99999999999999999999999.lcm"}) {
    EXPECT_FALSE(segment_number(name)) << name;
  }
}

TEST(Session, MarksComeBack) {
  for (const SegmentMark mark : {SegmentMark{}, SegmentMark{3, 17}, SegmentMark{~0ULL, ~0ULL}}) {
    EXPECT_EQ(parse_segment_mark(to_text(mark)), mark);
  }
  for (const char* text : {"", "number = ", "number = 1\n", "number = -1\nlost_events = 0\n",
                           "number = 1\nlost_events = 2", "number = 1\nlost_events = 2\nmore\n"}) {
    EXPECT_FALSE(parse_segment_mark(text)) << text;
  }
}

TEST(Session, SegmentsAreOneRunInTheOrderOfTheirNumbers) {
  const test::TemporaryFolder folder;
  SegmentText(folder / "1000.lcm", {2, 0}).samples(4);
  SegmentText(folder / "001.lcm", {1, 0}).samples(2).samples(3);
  SegmentText(folder / "000.lcm", {0, 0}).samples(0).samples(1);
  test::write(folder / "notes.txt", "not a segment");
  const auto run = load_run(folder.path());
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_THAT(numbers(run->odometry), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(run->bearings.size(), 5U);
  EXPECT_EQ(run->name, folder.path().filename());
  EXPECT_EQ(run->configuration_toml, "estimator = \"ekf\"\n");
  EXPECT_EQ(run->configuration_file, folder.path().string() + " (azimuth.toml)");
  EXPECT_EQ(run->recorded_by, "azimuthd 1.2.3");
  EXPECT_TRUE(run->from_the_start);
  EXPECT_EQ(run->skipped, Skipped{});
}

TEST(Session, MissingSegmentsAndLostEventsAreCounted) {
  const test::TemporaryFolder folder;
  SegmentText(folder / "002.lcm", {2, 5}).samples(0);
  SegmentText(folder / "004.lcm", {4, 9}).samples(1);
  const auto run = load_run(folder.path());
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_THAT(numbers(run->odometry), ElementsAre(0, 1));
  EXPECT_FALSE(run->from_the_start);
  EXPECT_EQ(run->skipped.missing_segments, 3U);
  EXPECT_EQ(run->skipped.text(), "3 segments of the session missing, 9 events not recorded");
}

TEST(Session, ImagesLieInSegmentsOfTheirOwn) {
  const test::TemporaryFolder folder;
  SegmentText(folder / "000.lcm", {0, 0}).samples(0).samples(1);
  std::filesystem::create_directory(folder / "frames");
  std::array<std::byte, 6> pixels{};
  const auto add = [&](std::uint64_t number, std::int64_t stamp_us) {
    SegmentText segment(folder / ("frames/" + segment_name(number)), {number, 7});
    pixels[0] = static_cast<std::byte>(number);
    image_t message{};
    fill_message({packed_format(PixelFormat::rgb8, 2, 1), pixels}, stamp_from_us(stamp_us), message);
    std::vector<std::byte> data;
    encode(message, data);
    segment.raw(channel::kCamera, data);
  };
  add(1, 10);
  add(3, 20);
  const auto run = load_run(folder.path());
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_EQ(run->bearings.size(), 2U);
  EXPECT_TRUE(run->from_the_start) << "which images that gave way to a quota do not change";
  EXPECT_EQ(run->skipped.text(), "2 segments of images missing, 7 images not recorded");
  ASSERT_EQ(run->frames.size(), 2U);
  FrameReader reader(run->folder);
  for (std::size_t i = 0; i < 2; ++i) {
    const ImageView image = reader.read(run->frames[i]);
    ASSERT_EQ(image.bytes.size(), 6U) << reader.problem();
    EXPECT_EQ(image.bytes[0], static_cast<std::byte>(2 * i + 1));
    EXPECT_EQ(image.format, packed_format(PixelFormat::rgb8, 2, 1));
  }
}

TEST(Session, OneSegmentIsARunByItself) {
  const test::TemporaryFolder folder;
  SegmentText(folder / "000.lcm", {0, 0}).samples(0);
  SegmentText(folder / "001.lcm", {1, 0}).samples(1);
  const auto run = load_run(folder / "001.lcm");
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_THAT(numbers(run->odometry), ElementsAre(1));
  EXPECT_FALSE(run->from_the_start);
}

TEST(Session, MarksThatMakeNoSenseAreMalformed) {
  const test::TemporaryFolder folder;
  SegmentText segment(folder / "000.lcm", {4, 0});
  segment.document(kSegmentDocument, to_text({3, 0}));
  segment.document(kSegmentDocument, "number = many\n");
  segment.samples(0);
  { const SegmentText flushed = std::move(segment); }
  const auto run = load_run(folder.path());
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_EQ(run->skipped.malformed_messages, 2U);
}

TEST(Session, EmptyAndCutSegmentsCostOnlyWhatTheyLack) {
  const test::TemporaryFolder folder;
  SegmentText(folder / "000.lcm", {0, 0}).samples(0);
  SegmentText(folder / "001.lcm", {1, 0}).samples(1);
  test::write(folder / "002.lcm", "");
  const std::string last = test::read(folder / "001.lcm");
  for (std::size_t cut = 0; cut < last.size(); ++cut) {
    test::write(folder / "001.lcm", last.substr(0, cut));
    const auto run = load_run(folder.path());
    ASSERT_TRUE(run) << "cut at " << cut << ": " << text(run.error());
    EXPECT_GE(run->odometry.size(), 1U);
  }
}

TEST(Session, ASessionOfEmptySegmentsIsNoLog) {
  const test::TemporaryFolder folder;
  test::write(folder / "000.lcm", "");
  EXPECT_THAT(text(load_run(folder.path()).error()), HasSubstr("holds no whole event"));
}

TEST(Session, AFolderWithARigIsARunFolder) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_run_folder(test::example_run(), folder.path()));
  SegmentText(folder / "000.lcm", {0, 0}).samples(0);
  const auto run = load_run(folder.path());
  ASSERT_TRUE(run);
  EXPECT_EQ(run->odometry.size(), test::example_run().odometry.size());
}

TEST(RecordedPoses, AreThoseOfSteps) {
  const test::TemporaryFolder folder;
  {
    SegmentText first(folder / "000.lcm", {0, 0}, "R1_"), second(folder / "001.lcm", {1, 0}, "R1_");
    first.pose(1, false).pose(2, true);
    first.raw(channel::kPose, std::as_bytes(std::span("short")));
    second.pose(3, false);
  }
  const auto poses = read_recorded_poses(folder.path(), {.channel_prefix = "R1_"});
  ASSERT_TRUE(poses);
  ASSERT_EQ(poses->size(), 2U);
  const RecordedPose& pose = (*poses)[1];
  EXPECT_EQ(to_us(pose.stamp), 3);
  EXPECT_EQ(pose.step, 3);
  EXPECT_EQ(pose.T_map_body, (Pose2{3.1, 0.0, 7.0}));
  EXPECT_EQ(pose.covariance[8], 0.3);
  EXPECT_EQ(pose.T_odom_body, (Pose2{0.0, -0.7, 0.0}));
  EXPECT_EQ(read_recorded_poses(folder.path())->size(), 0U);
  EXPECT_FALSE(read_recorded_poses(folder / "nowhere.lcm"));
}

TEST(Truth, ReplacesWhatTheRunHolds) {
  const test::TemporaryFolder folder;
  azimuth::Run run = test::example_run();
  const std::size_t landmarks = run.landmarks.size();
  test::write(folder / "truth.csv", "t_s,x_m,y_m,heading_rad\n1,2,3,0.5\n");
  test::write(folder / "landmarks.csv", "landmark_id,x_m,y_m\n9,1,2\n");
  EXPECT_TRUE(replace_truth(run, folder / "truth.csv").empty());
  EXPECT_EQ(run.truth, (std::vector{TruthPose{stamp_from_us(1'000'000), {2.0, 3.0, 0.5}}}));
  EXPECT_EQ(run.landmarks.size(), landmarks);
  EXPECT_TRUE(replace_truth(run, folder / "truth.csv", folder / "landmarks.csv").empty());
  ASSERT_EQ(run.landmarks.size(), 1U);
  EXPECT_EQ(run.landmarks[0].identity, 9);
}

TEST(Truth, WithErrorsLeavesTheRunAlone) {
  const test::TemporaryFolder folder;
  azimuth::Run run = test::example_run();
  test::write(folder / "truth.csv", "t_s,x_m,y_m,heading_rad\n1,2,3,0.5\n");
  test::write(folder / "landmarks.csv", "landmark_id,x_m,y_m\n9,1,far\n");
  const std::string errors = text(replace_truth(run, folder / "nowhere.csv", folder / "landmarks.csv"));
  EXPECT_THAT(errors, HasSubstr("nowhere.csv: cannot be opened"));
  EXPECT_THAT(errors, HasSubstr("landmarks.csv:2:"));
  EXPECT_EQ(run.truth, test::example_run().truth);
  EXPECT_EQ(run.landmarks.size(), test::example_run().landmarks.size());
}

}  // namespace
}  // namespace azimuth
