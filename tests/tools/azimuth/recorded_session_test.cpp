// Runs `azimuth replay` on a session that a daemon recorded, which holds the configuration and the poses, but no truth.

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "drivers/storage/event_log.hpp"
#include "drivers/storage/session.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"
#include "settings/configuration.hpp"
#include "settings/rig.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/tools/azimuth/command_line.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth::test {
namespace {

using testing::HasSubstr;

/// Differs from the default, so that a replay with the default settings gives other poses.
constexpr const char* kConfiguration =
    "estimator = \"ekf\"\n[ekf]\nthinning_s = 1.0\n[daemon.lcm]\nchannel_prefix = \"R1_\"\n";

class SegmentWriter {
 public:
  SegmentWriter(const std::filesystem::path& file, std::uint64_t number, std::string prefix)
      : log_(*EventLogWriter::create(file)), prefix_(std::move(prefix)) {
    document(kSegmentDocument, to_text(SegmentMark{number, 0}));
    document(kConfigurationDocument, kConfiguration);
    document(kVersionDocument, "azimuthd 0.0.7");
  }
  void document(const char* name, const std::string& text) { write(channel::kDocument, to_message(name, text, {})); }
  template <class Message>
  void write(std::string_view channel, const Message& message) {
    encode(message, data_);
    EXPECT_FALSE(log_.write(message.utime, prefix_ + std::string(channel), data_));
  }

 private:
  EventLogWriter log_;
  std::string prefix_;
  std::vector<std::byte> data_;
};

pose_cov_t message_of(const EstimateRecord& estimate, std::int64_t step) {
  pose_cov_t message{};
  message.utime = to_us(estimate.stamp);
  message.step = step;
  message.x_m = estimate.T_map_body.x_m;
  message.y_m = estimate.T_map_body.y_m;
  message.heading_rad = estimate.T_map_body.heading_rad;
  for (int i = 0; i < 9; ++i) message.covariance[i] = estimate.covariance(i / 3, i % 3);
  message.odom_x_m = estimate.T_odom_body.x_m;
  message.odom_y_m = estimate.T_odom_body.y_m;
  message.odom_heading_rad = estimate.T_odom_body.heading_rad;
  return message;
}

class RecordedSession : public testing::Test {
 protected:
  void SetUp() override {
    EXPECT_EQ(azimuth({"simulate", run_folder_, "--world", "coloured-lab"}).code, 0);
    run_ = *load_run(run_folder_);
    const Configuration configuration = *read_configuration(kConfiguration, "azimuth.toml");
    const Rig rig = *read_rig(run_.rig_toml, "rig.toml");
    poses_ = replay(run_, rig, make_ekf_estimator(rig, configuration.ekf), configuration.stage).estimates;
  }

  /// Writes the session as a daemon records it: two segments, poses between the samples, no truth.
  std::string record(const std::string& prefix = "") {
    const std::string session = scratch_ / "session";
    std::filesystem::create_directory(session);
    std::size_t reading = 0, set = 0;
    for (std::uint64_t number = 0; number < 2; ++number) {
      SegmentWriter segment(session + "/" + segment_name(number), number, prefix);
      segment.document("rig.toml", run_.rig_toml);
      for (; reading < run_.odometry.size() * (number + 1) / 2; ++reading)
        segment.write(channel::kOdometry, to_message(run_.odometry[reading]));
      for (; set < run_.bearings.size() * (number + 1) / 2; ++set)
        segment.write(channel::kBearings, to_message(run_.bearings[set]));
      for (std::size_t i = 0; number == 1 && i < poses_.size(); ++i)
        segment.write(channel::kPose, message_of(poses_[i], static_cast<std::int64_t>(i) + 1));
      pose_cov_t predicted{};  // A prediction between the steps, which the comparison must ignore.
      predicted.predicted = 1;
      segment.write(channel::kPose, predicted);
    }
    return session;
  }

  ScratchFolder scratch_;
  const std::string run_folder_ = scratch_ / "run";
  azimuth::Run run_;
  std::vector<EstimateRecord> poses_;
};

TEST_F(RecordedSession, ReplaysBitForBitWithItsOwnConfiguration) {
  const std::string session = record();
  const Outcome outcome = azimuth({"replay", session, "--verify"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string all = std::to_string(poses_.size());
  EXPECT_THAT(outcome.out, HasSubstr("settings    " + session + " (azimuth.toml)\n"));
  EXPECT_THAT(outcome.out, HasSubstr("verified    " + all + " of " + all + " recorded poses identical\n"));
  EXPECT_GT(poses_.size(), 30U);
}

TEST_F(RecordedSession, OtherSettingsGiveOtherPoses) {
  const std::string session = record(), empty = scratch_ / "empty.toml";
  write_file(empty, "");
  for (const std::vector<std::string>& other :
       {std::vector<std::string>{"--config", empty}, {"--set", "estimator=smoother"}}) {
    std::vector<std::string> arguments{"replay", session, "--verify", "--quiet"};
    arguments.insert(arguments.end(), other.begin(), other.end());
    const Outcome outcome = azimuth(arguments);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("recorded poses identical; first difference: step "));
    EXPECT_THAT(outcome.err, HasSubstr("recorded by azimuthd 0.0.7"));
  }
}

TEST_F(RecordedSession, OneBitIsADifference) {
  const std::size_t changed = poses_.size() / 2;
  double& value = poses_[changed].covariance(2, 1);
  value = std::nextafter(value, 1.0);
  const Outcome outcome = azimuth({"replay", record(), "--verify"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr(std::to_string(poses_.size() - 1) + " of " + std::to_string(poses_.size())));
  EXPECT_THAT(outcome.err, HasSubstr("step " + std::to_string(changed + 1) + " at "));
  EXPECT_THAT(outcome.err, HasSubstr("covariance[7] recorded as"));
}

TEST_F(RecordedSession, APoseWithoutItsStepIsADifference) {
  poses_.front().stamp -= Duration(1);
  const Outcome outcome = azimuth({"replay", record(), "--verify"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no replayed step has its stamp"));
}

TEST_F(RecordedSession, PrefixIsHonoured) {
  const std::string session = record("R1_");
  EXPECT_EQ(azimuth({"replay", session, "--verify", "--prefix", "R1_"}).code, 0);
  EXPECT_EQ(azimuth({"replay", session}).code, 2);
}

TEST_F(RecordedSession, CannotBeVerifiedWithoutItsStartOrItsPoses) {
  const std::string session = record();
  const Outcome part = azimuth({"replay", session + "/001.lcm", "--verify"});
  EXPECT_EQ(part.code, 2);
  EXPECT_THAT(part.err, HasSubstr("--verify needs the first segment"));
  EXPECT_THAT(azimuth({"replay", session + "/001.lcm"}).out, HasSubstr("1 segments of the session missing"));
  const Outcome poseless = azimuth({"replay", session + "/000.lcm", "--verify"});
  EXPECT_EQ(poseless.code, 2);
  EXPECT_THAT(poseless.err, HasSubstr("--verify finds no pose on AZIMUTH_POSE"));
}

TEST_F(RecordedSession, SeveralAreVerifiedOneAfterTheOther) {
  const std::string good = record(), other = scratch_ / "other", poseless = good + "/000.lcm";
  std::filesystem::copy(good, other);
  const std::string all = std::to_string(poses_.size());
  const Outcome both = azimuth({"replay", good, other, "--verify"});
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_THAT(both.out, HasSubstr("run         session,"));
  EXPECT_THAT(both.out, HasSubstr("run         other,"));
  EXPECT_EQ(azimuth({"replay", "--verify", good, other}).code, 0) << "in any order of words";

  poses_.front().T_map_body.x_m += 1.0;
  const std::string spoilt = record();
  const Outcome one = azimuth({"replay", spoilt, other, "--verify"});
  EXPECT_EQ(one.code, 1);
  EXPECT_THAT(one.err, HasSubstr(spoilt + ": "));
  EXPECT_THAT(one.err, HasSubstr("1 of 2 runs failed"));
  EXPECT_THAT(one.out, HasSubstr("verified    " + all + " of " + all));
  const Outcome missing = azimuth({"replay", poseless, other, "--verify"});
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.out, HasSubstr("verified    " + all + " of " + all)) << "the other has its turn";
  const Outcome files = azimuth({"replay", other, other, "--report", scratch_ / "report.json"});
  EXPECT_EQ(files.code, 2);
  EXPECT_THAT(files.err, HasSubstr("one RUN only"));
}

TEST_F(RecordedSession, IsReplayedWithAnotherRigIfOneIsGiven) {
  const std::string session = record(), rig = scratch_ / "rig.toml";
  write_file(rig, "[camera]\nmodel = \"bearings\"\nsigma_bearing_rad = 0.3\n");
  EXPECT_NE(digest_of(session, {"--rig", rig}), digest_of(session));
  write_file(rig, run_.rig_toml);
  EXPECT_EQ(digest_of(session, {"--rig", rig}), digest_of(session));
}

TEST_F(RecordedSession, IsJudgedByTruthFromElsewhere) {
  const std::string session = record(), report = scratch_ / "report.json";
  const auto json = [&](const std::vector<std::string>& truth) {
    std::vector<std::string> arguments{"replay", session, "--report", report};
    arguments.insert(arguments.end(), truth.begin(), truth.end());
    EXPECT_EQ(azimuth(arguments).code, 0);
    return nlohmann::json::parse(file_bytes(report));
  };
  const auto without = json({}), poses = json({"--truth", run_folder_ + "/truth.csv"}),
             both = json({"--truth-from", run_folder_});
  EXPECT_TRUE(without["pose"]["rmse_m"].is_null());
  EXPECT_LT(poses["pose"]["rmse_m"], 0.5);
  EXPECT_EQ(poses["map"]["true_landmarks"], 0);
  EXPECT_EQ(both["pose"]["rmse_m"], poses["pose"]["rmse_m"]);
  EXPECT_EQ(both["map"]["true_landmarks"], run_.landmarks.size());
  const Outcome nowhere = azimuth({"replay", session, "--truth-from", scratch_ / "nowhere"});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("nowhere/truth.csv"));
  EXPECT_THAT(nowhere.err, HasSubstr("nowhere/landmarks.csv"));
}

}  // namespace
}  // namespace azimuth::test
