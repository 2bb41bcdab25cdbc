// Field logs together with other programs: logs recorded by lcm-logger, logs played by lcm-logplayer, and images in
// which a replay finds the bearings anew. Runs in a network namespace of its own (in_namespace.sh).

#include <gmock/gmock.h>
#include <sstream>

#include "drivers/camera/run_images.hpp"
#include "drivers/storage/event_log.hpp"
#include "drivers/storage/session.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/image_message.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/daemon/lcm_logger.hpp"
#include "tests/daemon/run_files.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

constexpr auto kPatience = 120s;
constexpr int kAttempts = 6;

/// An event as others see it, without its number.
struct Heard {
  std::int64_t utime_us = 0;
  std::string channel;
  std::vector<std::byte> data;
};

std::vector<Heard> events_of(const fs::path& log) {
  std::vector<Heard> events;
  FileResult<EventLogReader> reader = EventLogReader::open(log);
  if (!reader) throw std::runtime_error(text(reader.error()));
  while (const auto event = reader->next())
    if (event->channel != test::LcmLogger::kProbe)
      events.push_back({event->utime_us, std::string(event->channel), {event->data.begin(), event->data.end()}});
  return events;
}

std::vector<std::string> channels_of(const std::vector<Heard>& events) {
  std::vector<std::string> channels;
  for (const Heard& event : events) channels.push_back(event.channel);
  return channels;
}

double duration_s(const std::vector<Heard>& events) {
  return 1e-6 * static_cast<double>(events.back().utime_us - events.front().utime_us);
}

class FieldLog : public ::testing::Test {
 protected:
  /// Runs the command to its end, expects the exit code, and returns all that it printed.
  std::string output_of(const std::vector<std::string>& command, int code = 0) const {
    test::ChildProcess process(command, folder_.path());
    EXPECT_EQ(process.wait(kPatience), code) << process.standard_error();
    return process.standard_output() + process.standard_error();
  }
  /// The log that lcm-logger writes while the command runs.
  fs::path logged(const std::string& name, const std::vector<std::string>& command) const {
    const fs::path log = folder_ / name;
    test::LcmLogger logger(log, folder_.path());
    if (logger.hears()) output_of(command);
    logger.finish();
    return log;
  }
  /// Plays the log with lcm-logplayer into another log. lcm-logger loses messages when it gets no processor time; then
  /// everything is repeated.
  fs::path played_on(const fs::path& log, const std::string& speed) const {
    for (int attempt = 1;; ++attempt) {
      const fs::path copy = logged("copy.lcm", {"lcm-logplayer", "--speed=" + speed, log});
      if (attempt == kAttempts || events_of(copy).size() == events_of(log).size()) return copy;
    }
  }
  void expect_same_events(const fs::path& log, const fs::path& copy) const {
    const std::vector<Heard> events = events_of(log), heard = events_of(copy);
    ASSERT_EQ(channels_of(heard), channels_of(events));
    for (std::size_t i = 0; i < events.size(); ++i) ASSERT_EQ(heard[i].data, events[i].data) << i;
  }
  void expect_verified(const fs::path& log, const std::vector<std::string>& options = {}) const {
    std::vector<std::string> command{AZIMUTH_COMMAND, "replay", log, "--verify"};
    command.insert(command.end(), options.begin(), options.end());
    EXPECT_THAT(output_of(command), HasSubstr("recorded poses identical"));
  }
  fs::path session() const { return fs::directory_iterator(folder_ / "log")->path(); }

  test::TemporaryFolder folder_;
};

TEST_F(FieldLog, WhatLcmLoggerHeardIsReplayedAndPlayedOn) {
  const fs::path run = test::write_run(test::small_recording(15.0), folder_ / "run");
  fs::path log;
  for (int attempt = 1; attempt <= kAttempts; ++attempt) {
    log = logged("lab.lcmlog", {AZIMUTHD, "--play", run, "--speed", "5"});
    const std::string outcome = output_of(
        {"sh", "-c", std::string(AZIMUTH_COMMAND) + " replay " + log.string() + " --verify --quiet 2>&1 || true"});
    if (outcome.empty()) break;  // lcm-logger heard everything
  }
  expect_verified(log);
  expect_verified(log, {"--rig", run / "rig.toml"});
  const fs::path copy = played_on(log, "1");
  expect_same_events(log, copy);
  expect_verified(copy);
  EXPECT_NEAR(duration_s(events_of(copy)), duration_s(events_of(log)), 1.0);
}

TEST_F(FieldLog, ARecordedSessionIsPlayedAtItsPaceAndNothingIsLost) {
  test::write_run(test::small_recording(20.0), folder_ / "run");
  // This rig is so long that LCM sends it in several fragments.
  const std::string rig = test::kSmallRig + std::string("# a long story\n") + std::string(300'000, '#') + '\n';
  test::write_text(folder_ / "run/rig.toml", rig);
  output_of({AZIMUTHD, "--play", folder_ / "run", "--speed", "max", "--record", folder_ / "log", "--lcm-url", "memq://",
             "--set", "daemon.record.min_free_mb=1"});
  const fs::path log = session() / "000.lcm";
  const std::vector<Heard> events = events_of(log);
  for (std::size_t i = 1; i < events.size(); ++i) ASSERT_GE(events[i].utime_us, events[i - 1].utime_us) << i;
  EXPECT_NEAR(duration_s(events), 20.0, 0.5) << "as long as the drive, however fast it was played";

  const fs::path copy = played_on(log, "4");
  expect_same_events(log, copy);
  EXPECT_NEAR(duration_s(events_of(copy)), 5.0, 1.5) << "at its pace";
  expect_verified(copy);
}

/// Writes a log with the run's images uncompressed, as a camera would send them.
void write_raw_log(const Run& run, const fs::path& file) {
  EventLogWriter log = *EventLogWriter::create(file);
  std::vector<std::byte> data;
  const auto write = [&](std::string_view channel, const auto& message) {
    encode(message, data);
    EXPECT_FALSE(log.write(message.utime, channel, data));
  };
  write(channel::kDocument, to_message("rig.toml", run.rig_toml, Stamp{}));
  for (const OdometryReading& reading : run.odometry) write(channel::kOdometry, to_message(reading));
  RunImages images(run);
  image_t message{};
  for (std::size_t i = 0; i < images.count(); ++i) {
    fill_message(images.pixels(i, PixelFormat::rgb8), run.frames[i].stamp, message);
    write(channel::kCamera, message);
  }
}

class FieldLogImages : public FieldLog {
 protected:
  /// Renders a short drive among coloured landmarks, with at most as many images as may wait for the disk.
  void SetUp() override {
    Scenario scenario = lab(1, 1);
    const Eigen::Vector2d start = scenario.path[0], ahead = (scenario.path[1] - start).normalized();
    scenario.path = {start, start + 0.8 * ahead};
    FileResult<azimuth::Run> rendered = rendered_run(scenario, {}, folder_ / "run");
    ASSERT_TRUE(rendered) << text(rendered.error());
    rendered->frames.resize(std::min<std::size_t>(rendered->frames.size(), 8));
    ASSERT_TRUE(write_run_folder(*rendered, folder_ / "run"));
    write_raw_log(*rendered, folder_ / "raw.lcm");
    frames_ = rendered->frames.size();
  }
  void record(const std::string& played, const std::string& frames) const {
    fs::remove_all(folder_ / "log");
    output_of({AZIMUTHD, "--play", folder_ / played, "--record", folder_ / "log", "--lcm-url", "memq://", "--set",
               "daemon.record.min_free_mb=1", "--set", "daemon.record.frames=\"" + frames + '"', "--set",
               "daemon.record.frames_quality=30"});
  }

  std::size_t frames_ = 0;
};

TEST_F(FieldLogImages, RawImagesAndThoseThatCameAsJpegGiveTheSameBits) {
  for (const auto& [played, frames] : {std::pair{"raw.lcm", "raw"}, {"run", "raw"}, {"run", "jpeg"}}) {
    record(played, frames);
    const std::string outcome = output_of({AZIMUTH_COMMAND, "replay", session(), "--perceive", "--verify"});
    EXPECT_THAT(outcome, HasSubstr(std::to_string(frames_) + " images")) << played;
    EXPECT_THAT(outcome, HasSubstr("recorded poses identical")) << played;
    expect_verified(session());
  }
}

TEST_F(FieldLogImages, CompressionIsALossThatVerifyNotices) {
  record("raw.lcm", "jpeg");
  expect_verified(session());
  const std::string outcome = output_of({AZIMUTH_COMMAND, "replay", session(), "--perceive", "--verify"}, 1);
  EXPECT_THAT(outcome, HasSubstr("first difference"));
  EXPECT_THAT(outcome, HasSubstr("compressed"));
}

TEST_F(FieldLogImages, WithoutImagesThereIsNothingToPerceive) {
  record("raw.lcm", "none");
  EXPECT_FALSE(fs::exists(session() / kFramesPart));
  EXPECT_THAT(output_of({AZIMUTH_COMMAND, "replay", session(), "--perceive"}, 2), HasSubstr("has no frames"));
}

}  // namespace
}  // namespace azimuth
