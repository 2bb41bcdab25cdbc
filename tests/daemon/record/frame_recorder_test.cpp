#include "daemon/record/frame_recorder.hpp"

#include <gmock/gmock.h>

#include "daemon/record/frame_pace.hpp"
#include "drivers/camera/run_images.hpp"
#include "tests/daemon/record/recording.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::Feeder;

constexpr int kWidth_px = 64, kHeight_px = 48;

/// A smooth image that differs from the image of every other number. Every byte of a yuyv image counts.
KeptImage image(std::uint64_t number, PixelFormat pixels) {
  KeptImage kept{.stamp = test::reading(number).stamp, .format = packed_format(pixels, kWidth_px, kHeight_px)};
  kept.bytes.resize(kept.format.bytes());
  const int bytes = bytes_per_pixel(pixels);
  for (std::size_t i = 0; i < kept.bytes.size(); ++i) {
    const int u = static_cast<int>(i) / bytes % kWidth_px;
    kept.bytes[i] = static_cast<std::byte>(40 + 2 * u + static_cast<int>(number % 50));
  }
  return kept;
}

KeptImage jpeg(std::uint64_t number) {
  const KeptImage grey = image(number, PixelFormat::gray8);
  JpegEncoder encoder;
  const auto bytes = encoder.encode({grey.format, grey.bytes}, 50);
  return {.stamp = grey.stamp,
          .format = packed_format(PixelFormat::mjpeg, kWidth_px, kHeight_px),
          .bytes = {bytes.begin(), bytes.end()}};
}

class FrameRecorderTest : public testing::Test {
 protected:
  RecordSettings settings(RecordedFrames frames) const {
    RecordSettings settings;
    settings.folder = folder_.path();
    settings.min_free_mb = 0.0;
    settings.frames = frames;
    return settings;
  }
  fs::path session() const { return test::sessions(folder_.path()).back(); }
  std::uintmax_t bytes_of_frames() const {
    std::uintmax_t bytes = 0;
    for (const fs::path& session : test::sessions(folder_.path()))
      for (const SegmentFile& segment : session_segments(session / kFramesPart)) bytes += fs::file_size(segment.file);
    return bytes;
  }

  test::TemporaryFolder folder_;
};

TEST_F(FrameRecorderTest, RawImagesComeBackBitForBit) {
  const std::vector<KeptImage> images{image(0, PixelFormat::gray8),       image(1, PixelFormat::rgb8),
                                      image(2, PixelFormat::yuyv),        image(3, PixelFormat::nv12),
                                      image(4, PixelFormat::bayer_grbg8), jpeg(5)};
  {
    Feeder feeder(settings(RecordedFrames::raw));
    feeder.feed(1);
    FrameRecorder recorder(settings(RecordedFrames::raw), EventTimes::of_recording(Stamp{}));
    recorder.begin(feeder.recorder().session());
    for (const KeptImage& kept : images) recorder.image(kept);
    EXPECT_EQ(recorder.status().events, images.size());
    EXPECT_EQ(recorder.status().lost_events, 0U);
  }
  const azimuth::Run run = test::load(session());
  EXPECT_EQ(run.skipped, Skipped{});
  ASSERT_EQ(run.frames.size(), images.size());
  RunImages recorded(run);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const ImageView view = recorded.recorded(i);
    EXPECT_EQ(run.frames[i].stamp, images[i].stamp);
    EXPECT_EQ(view.format, images[i].format) << i;
    EXPECT_TRUE(std::ranges::equal(view.bytes, images[i].bytes)) << i;
  }
}

TEST_F(FrameRecorderTest, JpegIsNearWhatWasSeenAndOfJpegTheVerySame) {
  const std::vector<KeptImage> images{image(0, PixelFormat::rgb8), image(1, PixelFormat::bgr8),
                                      image(2, PixelFormat::gray8)};
  const KeptImage sent_as_jpeg = jpeg(3);
  {
    Feeder feeder(settings(RecordedFrames::jpeg));
    feeder.feed(1);
    FrameRecorder recorder(settings(RecordedFrames::jpeg), EventTimes::of_recording(Stamp{}));
    recorder.begin(feeder.recorder().session());
    for (const KeptImage& kept : images) recorder.image(kept);
    recorder.image(sent_as_jpeg);
    for (const PixelFormat pixels : {PixelFormat::yuyv, PixelFormat::bayer_rggb8, PixelFormat::nv12})
      recorder.image(image(4 + static_cast<std::uint64_t>(pixels), pixels));
  }
  const azimuth::Run run = test::load(session());
  ASSERT_EQ(run.frames.size(), 7U);
  RunImages recorded(run);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const ImageView view = recorded.pixels(i, images[i].format.pixels);
    ASSERT_EQ(view.bytes.size(), images[i].bytes.size()) << recorded.problem();
    EXPECT_LT(recorded.recorded(i).bytes.size(), images[i].bytes.size() / 2);
    for (std::size_t k = 0; k < view.bytes.size(); ++k)
      ASSERT_NEAR(std::to_integer<int>(view.bytes[k]), std::to_integer<int>(images[i].bytes[k]), 12) << i << ' ' << k;
  }
  EXPECT_TRUE(std::ranges::equal(recorded.recorded(3).bytes, sent_as_jpeg.bytes));
  for (std::size_t i = 4; i < 7; ++i)
    EXPECT_EQ(recorded.pixels(i, PixelFormat::rgb8).format, packed_format(PixelFormat::rgb8, kWidth_px, kHeight_px));
}

TEST_F(FrameRecorderTest, OneThatCouldNotBeReadStaysOne) {
  for (const RecordedFrames form : {RecordedFrames::raw, RecordedFrames::jpeg}) {
    const KeptImage unreadable{.stamp = test::reading(1).stamp, .format = {}, .bytes = {}};
    {
      Feeder feeder(settings(form));
      feeder.feed(1);
      FrameRecorder recorder(settings(form), EventTimes::of_recording(Stamp{}));
      recorder.begin(feeder.recorder().session());
      recorder.image(unreadable);
    }
    const azimuth::Run run = test::load(session());
    ASSERT_EQ(run.frames.size(), 1U);
    EXPECT_TRUE(RunImages(run).recorded(0).bytes.empty());
  }
}

TEST_F(FrameRecorderTest, TheQuotaIsNeverPassedAndTakesNoSample) {
  RecordSettings small = settings(RecordedFrames::raw);
  small.frames_quota_mb = 0.4;
  { Feeder(small).feed(20); }  // an older session
  Feeder feeder(small);
  FrameRecorder recorder(small, EventTimes::of_recording(Stamp{}));
  recorder.begin(feeder.recorder().session());
  auto now = FrameRecorder::Clock::time_point(1000h);
  std::uintmax_t most = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {  // 4.6 MB
    feeder.feed(3);
    recorder.image(image(i, PixelFormat::rgb8));
    recorder.turn(now += 66ms);
    most = std::max(most, bytes_of_frames());
  }
  EXPECT_LE(most, 400'000U);
  EXPECT_GE(bytes_of_frames(), 200'000U) << "what it may take it takes";
  EXPECT_GT(recorder.status().segments_deleted, 10U);
  EXPECT_EQ(recorder.status().lost_events, 0U);
  EXPECT_EQ(feeder.status().segments_deleted, 0U);
  feeder.wait(1s);
  recorder.turn(now + 1s);
  const azimuth::Run run = test::load(session());
  EXPECT_EQ(run.odometry.size(), 1500U);
  EXPECT_TRUE(run.from_the_start);
  EXPECT_EQ(run.frames.back().stamp, test::reading(499).stamp);
  EXPECT_GT(run.skipped.missing_frame_segments, 10U);
  EXPECT_EQ(test::sessions(folder_.path()).size(), 2U);
  EXPECT_EQ(test::load(test::sessions(folder_.path()).front()).odometry.size(), 20U);
}

TEST_F(FrameRecorderTest, ImagesAreLostUntilThereIsASession) {
  const fs::path elsewhere = folder_ / "logs";
  RecordSettings there = settings(RecordedFrames::raw);
  there.folder = elsewhere;
  FrameRecorder recorder(there, EventTimes::of_recording(Stamp{}));
  recorder.begin("");
  recorder.image(image(0, PixelFormat::gray8));
  recorder.turn(FrameRecorder::Clock::time_point(1000h));
  EXPECT_EQ(recorder.status().lost_events, 1U);
  EXPECT_FALSE(fs::exists(elsewhere));
  Feeder feeder(there);
  recorder.begin(feeder.recorder().session());
  recorder.image(image(1, PixelFormat::gray8));
  EXPECT_EQ(recorder.status().events, 1U);
  EXPECT_TRUE(recorder.status().on);
}

TEST_F(FrameRecorderTest, NothingAllocatesOnceStorageHasGrown) {
  Feeder feeder(settings(RecordedFrames::raw));
  FrameRecorder recorder(settings(RecordedFrames::raw), EventTimes::of_recording(Stamp{}));
  recorder.begin(feeder.recorder().session());
  const KeptImage kept = image(0, PixelFormat::rgb8);
  for (int i = 0; i < 20; ++i) recorder.image(kept);
  const std::size_t before = allocations();
  for (int i = 0; i < 100; ++i) recorder.image(kept);
  EXPECT_EQ(allocations() - before, 0U);
}

/// The number of a camera's images that are recorded in 100 s, with jitter in the stamps.
int taken(double camera_hz, double wanted_hz) {
  FramePace pace(wanted_hz);
  int count = 0;
  for (int i = 0; i < static_cast<int>(100 * camera_hz); ++i) {
    const std::int64_t tremble_us = i % 3 == 0 ? 4000 : i % 5 == 0 ? -4000 : 0;
    count += pace.takes(stamp_from_us(static_cast<std::int64_t>(1e6 * i / camera_hz) + tremble_us)) ? 1 : 0;
  }
  return count;
}

TEST(FramePace, TakesAsManyAsAreWanted) {
  EXPECT_EQ(taken(15.0, 0.0), 1500);
  EXPECT_EQ(taken(15.0, 15.0), 1500) << "no less than all of a camera of that rate";
  EXPECT_EQ(taken(15.0, 30.0), 1500);
  EXPECT_NEAR(taken(15.0, 5.0), 500, 2);
  EXPECT_NEAR(taken(30.0, 4.0), 400, 2);
  EXPECT_NEAR(taken(15.0, 10.0), 1000, 60);
}

TEST(FramePace, GoesOnAfterGapsAndJumps) {
  FramePace pace(1.0);
  EXPECT_TRUE(pace.takes(stamp_from_us(0)));
  EXPECT_FALSE(pace.takes(stamp_from_us(300'000)));
  EXPECT_TRUE(pace.takes(stamp_from_us(60'000'000)));
  EXPECT_FALSE(pace.takes(stamp_from_us(60'300'000))) << "no haste to make up for the gap";
  EXPECT_TRUE(pace.takes(stamp_from_us(5'000'000))) << "a clock that was put back";
  EXPECT_FALSE(pace.takes(stamp_from_us(5'300'000)));
}

}  // namespace
}  // namespace azimuth
