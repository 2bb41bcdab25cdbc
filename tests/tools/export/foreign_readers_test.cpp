// Reads exported bags and MCAP files with three readers: the library of ROS, a reader written from the specification of
// MCAP, and the import of this project.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <span>
#include <sys/wait.h>
#include <utility>

#include "tests/support/places.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/tools/export/sample.hpp"
#include "tools/export/export_file.hpp"
#include "tools/export/ros_recording.hpp"
#include "tools/import/bag_file.hpp"
#include "tools/import/bag_run.hpp"
#include "tools/import/ros_message.hpp"

namespace azimuth::test {
namespace {

using Json = nlohmann::json;

struct Said {
  int code = -1;
  std::string text;
};

Said reader_says(const std::string& reader, const std::filesystem::path& file) {
  const std::string script = (source_folder() / "tests/tools/export" / reader).string();
  const std::string command = "/usr/bin/python3 -B '" + script + "' '" + file.string() + "' 2>&1";
  Said said;
  FILE* const pipe = ::popen(command.c_str(), "r");
  std::array<char, 65536> piece{};
  for (std::size_t size = 0; (size = std::fread(piece.data(), 1, piece.size(), pipe)) > 0;)
    said.text.append(piece.data(), size);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) said.code = WEXITSTATUS(status);
  return said;
}

double heading(const Json& q) { return 2.0 * std::atan2(q["z"].get<double>(), q["w"].get<double>()); }

void expect_pose(const Json& pose, const Pose2& expected) {
  EXPECT_EQ(pose["position"]["x"], expected.x_m);
  EXPECT_EQ(pose["position"]["y"], expected.y_m);
  EXPECT_EQ(pose["position"]["z"], 0.0);
  EXPECT_NEAR(wrap(heading(pose["orientation"]) - expected.heading_rad), 0.0, 1e-12);
}

class ForeignReaders : public testing::Test {
 protected:
  std::filesystem::path write(const Estimated& estimated, ExportFormat format, const std::string& name) {
    const Exported content = exported(estimated, format, std::nullopt);
    EXPECT_TRUE(content);
    std::ofstream(folder_.path() / name, std::ios::binary) << content.value_or("");
    return folder_.path() / name;
  }

  /// Checks every value of every message as a reader decoded it with the definitions in the file.
  static void expect_sample(const Json& topics) {
    ASSERT_EQ(topics.size(), kRecordedTopics.size());
    const Json& poses = topics["/azimuth/pose"]["messages"];
    ASSERT_EQ(poses.size(), 80u);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const EstimatedPose expected = sample_pose(static_cast<std::int64_t>(i));
      EXPECT_EQ(poses[i]["time_ns"], 1000 * to_us(expected.stamp));
      const Json& message = poses[i]["message"];
      EXPECT_EQ(message["header"]["frame_id"], "map");
      EXPECT_EQ(message["header"]["stamp"]["sec"], 1'700'000'000 + i / 10);
      EXPECT_EQ(message["header"]["stamp"]["nanosec"], i % 10 * 100'000'000);
      expect_pose(message["pose"]["pose"], expected.T_map_body);
      EXPECT_EQ(message["pose"]["covariance"][0], 0.04);
      EXPECT_EQ(message["pose"]["covariance"][11], -0.003);
      EXPECT_EQ(message["pose"]["covariance"][35], 0.01);
    }
    const Json& odometry = topics["/odom"]["messages"][20]["message"];
    EXPECT_EQ(odometry["header"]["frame_id"], "odom");
    EXPECT_EQ(odometry["child_frame_id"], "base_link");
    expect_pose(odometry["pose"]["pose"], *sample_pose(20).T_odom_body);
    EXPECT_NEAR(odometry["twist"]["twist"]["linear"]["x"].get<double>(), 1.0, 1e-3);
    EXPECT_NEAR(odometry["twist"]["twist"]["angular"]["z"].get<double>(), 0.5, 1e-9);
    const Json& transforms = topics["/tf"]["messages"][20]["message"]["transforms"];
    ASSERT_EQ(transforms.size(), 2u);
    EXPECT_EQ(transforms[0]["child_frame_id"], "odom");
    EXPECT_EQ(transforms[1]["transform"]["translation"]["x"], sample_pose(20).T_odom_body->x_m);
    const Json& path = topics["/azimuth/path"]["messages"];
    ASSERT_EQ(path.size(), 1u);
    EXPECT_EQ(path[0]["time_ns"], 1000 * kSampleBegin_us);
    ASSERT_EQ(path[0]["message"]["poses"].size(), 80u);
    expect_pose(path[0]["message"]["poses"][79]["pose"], sample_pose(79).T_map_body);
    EXPECT_EQ(path[0]["message"]["poses"][79]["header"]["frame_id"], "map");
    const Json& markers = topics["/azimuth/landmarks"]["messages"][0]["message"]["markers"];
    ASSERT_EQ(markers.size(), 1 + 3 * 3u);
    EXPECT_EQ(markers[0]["action"], 3);
    EXPECT_EQ(markers[2]["ns"], "uncertainty");
    EXPECT_NEAR(markers[2]["scale"]["x"].get<double>(), 1.2, 1e-9);
    EXPECT_EQ(markers[3]["text"], "42");
    EXPECT_EQ(markers[4]["pose"]["position"]["z"], 2.5);
    EXPECT_EQ(markers[9]["text"], "#12");
    EXPECT_EQ(markers[9]["mesh_use_embedded_materials"], false) << "the last value of a marker";
    const Json& diagnostics = topics["/diagnostics"]["messages"];
    EXPECT_EQ(diagnostics.size(), 9u);
    EXPECT_EQ(diagnostics.back()["message"]["status"][0]["level"], 1);
    EXPECT_EQ(diagnostics.back()["message"]["status"][0]["values"][0]["value"], "degraded");
  }

  TemporaryFolder folder_;
};

TEST_F(ForeignReaders, ReadEveryValueOfAnMcapFile) {
  const Said said = reader_says("read_mcap.py", write(sample(), ExportFormat::mcap, "a.mcap"));
  ASSERT_EQ(said.code, 0) << said.text;
  const Json json = Json::parse(said.text);
  EXPECT_EQ(json["profile"], "ros2");
  for (const auto& [name, topic] : json["topics"].items()) {
    EXPECT_EQ(topic["encoding"], "cdr") << name;
    EXPECT_EQ(topic["schema_encoding"], "ros2msg") << name;
    EXPECT_EQ(topic["metadata"], (Json{{"offered_qos_profiles", ""}})) << "as the profile wants it";
  }
  EXPECT_EQ(json["topics"]["/tf"]["type"], "tf2_msgs/msg/TFMessage");
  expect_sample(json["topics"]);
}

TEST_F(ForeignReaders, FindTheirWayThroughManyChunks) {
  const Said said = reader_says("read_mcap.py", write(sample(1000), ExportFormat::mcap, "a.mcap"));
  ASSERT_EQ(said.code, 0) << said.text.substr(0, 1000);
  const Json json = Json::parse(said.text);
  EXPECT_GE(json["chunks"], 2);
  EXPECT_EQ(json["topics"]["/odom"]["messages"].size(), 1000u);
}

TEST_F(ForeignReaders, NoticeADamagedMcapFile) {
  const std::string whole = *exported(sample(20), ExportFormat::mcap, std::nullopt);
  std::size_t unnoticed = 0, tried = 0;
  for (std::size_t at = 0; at < whole.size(); at += whole.size() / 12, ++tried) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    std::ofstream(folder_.path() / "a.mcap", std::ios::binary) << damaged;
    if (reader_says("read_mcap.py", folder_.path() / "a.mcap").code == 0) ++unnoticed;
  }
  EXPECT_EQ(unnoticed, 0u) << "of " << tried;
}

TEST_F(ForeignReaders, OfRosReadEveryValueOfABag) {
  const Said said = reader_says("read_bag.py", write(sample(), ExportFormat::bag, "a.bag"));
  if (said.code == 77) GTEST_SKIP() << "python3-rosbag is not installed: " << said.text;
  ASSERT_EQ(said.code, 0) << said.text;
  const Json json = Json::parse(said.text);
  EXPECT_EQ(json["begin_s"], 1.7e9);
  EXPECT_EQ(json["end_s"], 1.7e9 + 7.9);
  for (const auto& [name, topic] : json["topics"].items())
    EXPECT_EQ(topic["checksum"], topic["worked_out"]) << name << ": subscribers refuse another";
  expect_sample(json["topics"]);
}

TEST_F(ForeignReaders, OfRosReadBagsOfManyChunks) {
  const Said said = reader_says("read_bag.py", write(sample(1000), ExportFormat::bag, "a.bag"));
  if (said.code == 77) GTEST_SKIP() << "python3-rosbag is not installed: " << said.text;
  ASSERT_EQ(said.code, 0) << said.text.substr(0, 1000);
  EXPECT_EQ(Json::parse(said.text)["topics"]["/tf"]["messages"].size(), 1000u);
}

TEST_F(ForeignReaders, OurImportReadsWhatOurExportWrites) {
  for (const auto& [format, name] : {std::pair{ExportFormat::bag, "a.bag"}, {ExportFormat::mcap, "a.mcap"}}) {
    const auto bag = BagFile::open(write(sample(), format, name));
    ASSERT_TRUE(bag) << text(bag.error());
    EXPECT_EQ(bag->damage(), "");
    EXPECT_EQ(bag->topics().size(), kRecordedTopics.size());
    const auto choice = choose_topics(name, bag->topics(), {"/odom", "", "/azimuth/pose", false});
    ASSERT_TRUE(choice) << text(choice.error());
    BagRun samples;
    const auto read = read_bag_samples(*bag, name, *choice, {}, samples);
    ASSERT_TRUE(read) << text(read.error());
    std::vector<std::string> notes;
    const auto finished = finish_bag_run(std::move(samples), name, notes);
    ASSERT_TRUE(finished);
    const azimuth::Run& run = *finished;
    ASSERT_EQ(run.odometry.size(), 80u);
    ASSERT_EQ(run.truth.size(), 80u);
    for (std::int64_t i = 0; i < 80; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const EstimatedPose expected = sample_pose(i);
      EXPECT_EQ(run.odometry[at].stamp, expected.stamp);
      EXPECT_EQ(run.odometry[at].T_odom_body.position(), expected.T_odom_body->position());
      EXPECT_EQ(run.truth[at].T_world_body.position(), expected.T_map_body.position());
      EXPECT_NEAR(wrap(run.truth[at].T_world_body.heading_rad - expected.T_map_body.heading_rad), 0.0, 1e-12);
    }
  }
}

TEST_F(ForeignReaders, ReadARunThatBeginsAtZero) {
  Estimated estimated = sample(3);
  for (std::size_t i = 0; i < 3; ++i) estimated.poses[i].stamp = stamp_from_us(static_cast<std::int64_t>(i) * 100'000);
  const Said said = reader_says("read_bag.py", write(estimated, ExportFormat::bag, "a.bag"));
  if (said.code != 77) {
    EXPECT_EQ(Json::parse(said.text)["topics"]["/odom"]["messages"][0]["time_ns"], 1) << "0 is no time in ROS";
  }
  const Said of_mcap = reader_says("read_mcap.py", write(estimated, ExportFormat::mcap, "a.mcap"));
  ASSERT_EQ(of_mcap.code, 0) << of_mcap.text;
  EXPECT_EQ(Json::parse(of_mcap.text)["topics"]["/odom"]["messages"][2]["time_ns"], 200'000'000);
}

}  // namespace
}  // namespace azimuth::test
