#include "daemon/pipeline/perception_stage.hpp"

#include <gmock/gmock.h>
#include <thread>

#include "tests/daemon/fake_perception.hpp"
#include "tests/daemon/small_frames.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::kSmallFrame;
using testing::IsEmpty;
using testing::SizeIs;

constexpr FrameFormat kJpeg{PixelFormat::mjpeg, 16, 16, 0};

PerceptionStage stage(test::FakePerception::OnImage on_image = {}) {
  return {std::make_unique<test::FakePerception>(std::move(on_image)), PixelFormat::gray8};
}

/// A JPEG image of a uniform grey, which compression does not change.
std::vector<std::byte> grey_jpeg(std::uint8_t grey) {
  const std::vector<std::byte> pixels(16 * 16, std::byte{grey});
  JpegEncoder encoder;
  const auto file = encoder.encode({packed_format(PixelFormat::gray8, 16, 16), pixels}, 95);
  return {file.begin(), file.end()};
}

Frame jpeg_frame(std::span<const std::byte> file) { return {nullptr, 0, kJpeg, file}; }

/// A used bearing set, as the wires return it: it still holds other data.
BearingSet used_set() {
  BearingSet set{.stamp = stamp_from_us(1), .sequence = 99, .bearings = std::vector<Bearing>(7)};
  set.descriptors.resize(7);
  set.neighbours.resize(7);
  set.trouble = ImageTrouble::frozen;
  return set;
}

TEST(PerceptionStage, BearingsCarryTheFramesStampAndSequence) {
  test::SmallPool pool;
  PerceptionStage perception = stage();
  BearingSet set = used_set();
  perception.observe(*pool.make(stamp_from_us(1234), 56, 3, 128), set);
  EXPECT_EQ(set.stamp, stamp_from_us(1234));
  EXPECT_EQ(set.sequence, 56U);
  EXPECT_EQ(set.trouble, ImageTrouble::none);
  ASSERT_THAT(set.bearings, SizeIs(3));
  EXPECT_NEAR(set.bearings[1].azimuth_rad, 0.01, 1e-12);
  EXPECT_THAT(set.descriptors, IsEmpty());
}

TEST(PerceptionStage, DecodesCompressedFrames) {
  const std::vector<std::byte> file = grey_jpeg(5);
  FrameFormat seen;
  PerceptionStage perception = stage([&](const ImageView& image) { seen = image.format; });
  BearingSet set = used_set();
  perception.observe(jpeg_frame(file), set);
  EXPECT_EQ(seen, packed_format(PixelFormat::gray8, 16, 16));
  EXPECT_EQ(set.trouble, ImageTrouble::none);
  EXPECT_THAT(set.bearings, SizeIs(5));
}

TEST(PerceptionStage, SaysWhichFramesCannotBeRead) {
  const std::vector<std::byte> file = grey_jpeg(5);
  const std::vector<std::byte> pixels(kSmallFrame.bytes());
  const auto part = std::span(pixels).first(10);
  PerceptionStage perception = stage();
  BearingSet set;
  std::uint64_t frames = 0;
  for (const Frame& frame :
       {Frame(), jpeg_frame(std::span(file).first(file.size() / 2)), jpeg_frame(std::span(file).first(1)),
        jpeg_frame(pixels), Frame(nullptr, 0, kSmallFrame, part),
        Frame(nullptr, 0, FrameFormat{PixelFormat::rgb8, 1 << 20, -3, 7}, pixels)}) {
    set = used_set();
    perception.observe(frame, set);
    EXPECT_EQ(set.trouble, ImageTrouble::unreadable);
    EXPECT_THAT(set.bearings, IsEmpty());
    EXPECT_THAT(set.descriptors, IsEmpty());
    ++frames;
  }
  perception.observe(jpeg_frame(file), set);
  EXPECT_EQ(set.trouble, ImageTrouble::none) << "and goes on";
  const PerceptionStatus& status = perception.status();
  EXPECT_EQ(status.frames, frames + 1);
  EXPECT_EQ(status.frames_unusable, frames);
  EXPECT_EQ(status.trouble, ImageTrouble::none);
}

TEST(PerceptionStage, ReportsOnceASecondAndWhenTroubleComesOrGoes) {
  test::SmallPool pool;
  PerceptionStage perception = stage([](const ImageView&) { std::this_thread::sleep_for(2ms); });
  const PerceptionStatus& status = perception.status();
  BearingSet set;
  auto now = PerceptionStage::Clock::now();
  EXPECT_TRUE(perception.is_news(now));
  perception.observe(*pool.make({}, 0, 1, 128), set);
  EXPECT_FALSE(perception.is_news(now + 500ms));
  EXPECT_TRUE(perception.is_news(now + 1001ms));
  EXPECT_EQ(status.frames, 1U);
  EXPECT_GE(status.detect_mean_us, 2000.0);
  EXPECT_GE(status.detect_max_us, status.detect_mean_us);
  perception.observe(Frame(), set);
  EXPECT_TRUE(perception.is_news(now + 1100ms));
  EXPECT_EQ(status.trouble, ImageTrouble::unreadable);
  EXPECT_FALSE(perception.is_news(now + 1200ms));
}

}  // namespace
}  // namespace azimuth
