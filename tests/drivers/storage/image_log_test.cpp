// Runs whose images are in an LCM log.

#include <algorithm>
#include <gmock/gmock.h>
#include <vector>

#include "drivers/storage/event_log.hpp"
#include "drivers/storage/frame_reader.hpp"
#include "drivers/storage/run.hpp"
#include "drivers/wire/image_message.hpp"
#include "drivers/wire/messages.hpp"
#include "tests/drivers/storage/samples.hpp"

namespace azimuth {
namespace {

using ::testing::HasSubstr;

const std::string kBytes = "\xFF\xD8 as good as an image to whoever does not decode it";

std::string text_of(const ImageView& image) {
  return {reinterpret_cast<const char*>(image.bytes.data()), image.bytes.size()};
}

class ImageLog : public testing::Test {
 protected:
  ImageLog() {
    run_ = test::example_run();
    run_.bearings.clear();
    run_.folder = folder_ / "run";
    std::filesystem::create_directories(run_.folder / "frames");
    for (const FrameFile& frame : run_.frames) test::write(run_.folder / frame.file, kBytes + frame.file);
  }

  std::filesystem::path log() const { return folder_ / "run.lcm"; }
  azimuth::Run written_and_read(const LogOptions& options = {}) {
    EXPECT_TRUE(write_run_log(run_, log(), options));
    return read(options);
  }
  azimuth::Run read(const LogOptions& options = {}) {
    FileResult<azimuth::Run> run = load_run(log(), options);
    EXPECT_TRUE(run) << text(run.error());
    return run ? *std::move(run) : azimuth::Run{};
  }
  /// A log with odometry and these images on CAMERA.
  void write_log(const std::vector<std::pair<ImageView, std::int64_t>>& images, const std::string& channel = "CAMERA") {
    auto writer = EventLogWriter::create(log());
    std::vector<std::byte> data;
    const auto write = [&](const std::string& name, const auto& message) {
      encode(message, data);
      EXPECT_FALSE(writer->write(message.utime, name, data));
    };
    write("AZIMUTH_DOCUMENT", to_message("rig.toml", "front_end = \"colour\"\n", stamp_from_us(0)));
    write("AZIMUTH_ODOM", to_message(run_.odometry.front()));
    image_t message{};
    for (const auto& [image, t_us] : images) {
      fill_message(image, stamp_from_us(t_us), message);
      if (unknown_format_) message.pixelformat = 357;
      write(channel, message);
    }
  }

  test::TemporaryFolder folder_;
  azimuth::Run run_;
  bool unknown_format_ = false;
};

TEST_F(ImageLog, PngIsRefusedForMessagesHaveNoSuchFormat) {
  test::write(run_.folder / run_.frames.back().file, "\x89PNG\r\n\x1a\n and so on");
  const auto written = write_run_log(run_, log());
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().front().text(), HasSubstr(run_.frames.back().file + ": is a PNG image"));
}

TEST_F(ImageLog, FramesOfAFolderComeBackByteForByte) {
  const azimuth::Run back = written_and_read();
  ASSERT_EQ(back.frames.size(), run_.frames.size());
  EXPECT_EQ(back.skipped, Skipped{});
  FrameReader reader(back.folder);
  for (std::size_t i = 0; i < back.frames.size(); ++i) {
    EXPECT_EQ(back.frames[i].stamp, run_.frames[i].stamp);
    const ImageView image = reader.read(back.frames[i]);
    EXPECT_EQ(image.format.pixels, PixelFormat::mjpeg);
    EXPECT_EQ(text_of(image), kBytes + run_.frames[i].file) << reader.problem();
  }
}

TEST_F(ImageLog, AndBecomeFilesAgain) {
  const azimuth::Run in_log = written_and_read();
  ASSERT_TRUE(write_run_folder(in_log, folder_ / "again"));
  const auto again = load_run(folder_ / "again");
  ASSERT_TRUE(again) << text(again.error());
  ASSERT_EQ(again->frames, run_.frames) << "which are named as those of the log are";
  for (const FrameFile& frame : again->frames) EXPECT_EQ(test::read(again->folder / frame.file), kBytes + frame.file);
}

TEST_F(ImageLog, AMissingFrameStaysAnUnreadableOne) {
  std::filesystem::remove(run_.folder / run_.frames[0].file);
  const azimuth::Run back = written_and_read();
  ASSERT_EQ(back.frames.size(), run_.frames.size());
  FrameReader reader(back.folder);
  EXPECT_TRUE(reader.read(back.frames[0]).bytes.empty());
  EXPECT_EQ(reader.problem(), "is empty");
  EXPECT_FALSE(reader.read(back.frames[1]).bytes.empty());
  ASSERT_TRUE(write_run_folder(back, folder_ / "again"));
  EXPECT_EQ(test::read(folder_ / "again/frames/000000.jpg"), "");
}

TEST_F(ImageLog, ChannelWithAndWithoutPrefix) {
  EXPECT_EQ(written_and_read({.channel_prefix = "R1_"}).frames.size(), 2U);
  const LogOptions omni{.channel_prefix = "", .image_channel = "OMNI"};
  EXPECT_EQ(written_and_read(omni).frames.size(), 2U);
  EXPECT_FALSE(load_run(log())) << "nothing on CAMERA";
  const std::vector<std::byte> pixels(64);
  write_log({{{packed_format(PixelFormat::gray8, 8, 8), pixels}, 1}}, "FRONT_CAMERA");
  EXPECT_EQ(read({.channel_prefix = "", .image_channel = "FRONT_CAMERA"}).frames.size(), 1U);
}

TEST_F(ImageLog, UncompressedImagesLieWhereTheyAre) {
  std::vector<std::byte> pixels(16 * 12);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::byte>(i);
  const FrameFormat format{PixelFormat::gray8, 14, 12, 16};
  write_log({{{format, pixels}, 5}, {{packed_format(PixelFormat::rgb8, 8, 8), pixels}, 6}});
  const azimuth::Run run = read();
  ASSERT_EQ(run.frames.size(), 2U);
  FrameReader reader(run.folder);
  const ImageView image = reader.read(run.frames[0]);
  EXPECT_EQ(image.format, format);
  EXPECT_TRUE(std::ranges::equal(image.bytes, pixels));
  EXPECT_THAT(write_run_folder(run, folder_ / "again").error().front().message, HasSubstr("without loss"));

  ASSERT_TRUE(write_run_log(run, folder_ / "copy.lcm"));
  const auto copy = load_run(folder_ / "copy.lcm");
  ASSERT_TRUE(copy);
  FrameReader copies(copy->folder);
  EXPECT_TRUE(std::ranges::equal(copies.read(copy->frames[0]).bytes, pixels));
  EXPECT_EQ(copy->frames[0].part->format, format);
}

TEST_F(ImageLog, WhatCannotBeUsedIsCounted) {
  const std::vector<std::byte> pixels(64);
  const ImageView good{packed_format(PixelFormat::gray8, 8, 8), pixels};
  const ImageView cut{packed_format(PixelFormat::gray8, 8, 9), pixels};
  write_log({{good, 1}, {cut, 2}, {good, 3}, {good, 3}, {good, 2}});
  const azimuth::Run run = read();
  EXPECT_EQ(run.frames.size(), 2U);
  EXPECT_EQ(run.skipped.malformed_messages, 1U);
  EXPECT_EQ(run.skipped.frames_not_in_order, 2U);
  EXPECT_THAT(run.skipped.text(), HasSubstr("2 images not in order"));
  unknown_format_ = true;
  write_log({{good, 1}});
  EXPECT_THAT(text(load_run(log()).error()), HasSubstr("1 images in formats that cannot be read"));
}

TEST_F(ImageLog, ALogThatWasCutMeanwhile) {
  const azimuth::Run run = written_and_read();
  std::filesystem::resize_file(log(), run.frames[1].part->offset + 3);
  FrameReader reader(run.folder);
  EXPECT_EQ(text_of(reader.read(run.frames[0])), kBytes + run_.frames[0].file);
  EXPECT_TRUE(reader.read(run.frames[1]).bytes.empty());
  EXPECT_EQ(reader.problem(), "has become shorter");
  std::filesystem::remove(log());
  FrameReader late(run.folder);
  EXPECT_TRUE(late.read(run.frames[0]).bytes.empty());
  EXPECT_THAT(late.problem(), HasSubstr("cannot be opened"));
}

}  // namespace
}  // namespace azimuth
