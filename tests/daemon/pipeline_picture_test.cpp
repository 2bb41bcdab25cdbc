// Pictures on their way through the threads: each picture shows the image that it names, with the expectations for
// exactly that image.

#include <fstream>
#include <gtest/gtest.h>

#include "daemon/pipeline/pipeline.hpp"
#include "tests/daemon/fake_estimator.hpp"
#include "tests/daemon/fake_perception.hpp"
#include "tests/daemon/small_frames.hpp"
#include "tests/daemon/small_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// An estimator that expects one landmark straight ahead.
class ExpectingEstimator final : public Estimator {
 public:
  void predict(const Motion& motion) override { inner_.predict(motion); }
  void update(const BearingSet& set) override { inner_.update(set); }
  void estimate(Estimate& out) const override { inner_.estimate(out); }
  void look_ahead(const Motion& motion, Estimate& out) const override { inner_.look_ahead(motion, out); }
  void expect(std::vector<ExpectedBearing>& out) const override {
    out.assign(1, {.landmark = 7, .azimuth_rad = 0.0, .gate_rad = 0.5});
  }

 private:
  test::FakeEstimator inner_;
};

constexpr int kWidth_px = 160, kHeight_px = 120;

CameraRig small_camera() {
  CameraRig rig;
  rig.model = RadialRig{};
  rig.image.width_px = kWidth_px;
  rig.image.height_px = kHeight_px;
  rig.image.mask_inner_px = 10.0;
  rig.image.mask_outer_px = 50.0;
  return rig;
}

/// Images whose brightness encodes their number. Each has two bearings, one of them straight ahead.
class Images {
 public:
  ImageView read(std::size_t index) {
    std::ranges::fill(pixels_, static_cast<std::byte>(60 + index % 100));
    const std::byte head[] = {std::byte{2}, std::byte{128}, std::byte{228}};
    std::ranges::copy(head, pixels_.begin());
    return {format_, pixels_};
  }

 private:
  FrameFormat format_ = packed_format(PixelFormat::gray8, kWidth_px, kHeight_px);
  std::vector<std::byte> pixels_ = std::vector<std::byte>(format_.bytes());
};

class PipelinePicture : public ::testing::Test {
 protected:
  std::string file() const { return (folder_.path() / "newest.jpg").string(); }

  /// Plays 2 s of the small run with images in place of its bearings; `with_odometry` keeps the odometry.
  std::uint64_t play(bool with_odometry) {
    Recording recording = test::small_recording(2.0);
    for (const BearingSet& set : recording.bearings) recording.frames.push_back(set.stamp);
    recording.bearings.clear();
    if (!with_odometry) recording.odometry.clear();
    std::vector<std::unique_ptr<Source>> sources;
    sources.push_back(
        std::make_unique<PlayedSource>(recording, 2.0, [this](std::size_t index) { return images_.read(index); }));
    PublishSettings quiet;
    quiet.lcm_url = "memq://";
    Doorbell bell;
    Pipeline pipeline({.sources = std::move(sources),
                       .perception = PerceptionStage(std::make_unique<test::FakePerception>(), PixelFormat::gray8),
                       .estimator = EstimatorStage(std::make_unique<ExpectingEstimator>(), Rig{}, StageSettings{}),
                       .publisher = Publisher(quiet),
                       .painter = Painter({.rate_hz = 50.0, .file = file()}, quiet, small_camera())},
                      ThreadSettings{}, bell);
    pipeline.start();
    for (int i = 0; i < 600 && !pipeline.finished(); ++i) bell.wait(100ms);
    if (!with_odometry) std::this_thread::sleep_for(1s);  // as long as the painter waits for a pose
    pipeline.stop();
    return pipeline.digest().estimates();
  }

  ImageView picture() {
    std::ifstream in(file(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    return decoder_.decode(std::as_bytes(std::span(text)), PixelFormat::rgb8);
  }
  /// The colour of the picture at a pixel of the image.
  std::array<int, 3> colour_at(const ImageView& view, int u, int v) const {
    const std::uint8_t* const pixel = view.row(v + Canvas::kMargin_px) + 3 * (u + Canvas::kMargin_px);
    return {pixel[0], pixel[1], pixel[2]};
  }

  test::TemporaryFolder folder_;
  Images images_;
  JpegDecoder decoder_;
};

TEST_F(PipelinePicture, ShowsAnImageWithWhatWasExpectedOfIt) {
  EXPECT_GT(play(true), 5U);
  const ImageView drawn = picture();
  ASSERT_EQ(drawn.format.width_px, kWidth_px + 2 * Canvas::kMargin_px);
  EXPECT_GE(colour_at(drawn, 3, kHeight_px - 4)[0], 60 - 8) << "an image of those played";
  // ahead is on the right in this camera's image
  const auto explained = colour_at(drawn, kWidth_px / 2 + 30, kHeight_px / 2);
  EXPECT_GT(explained[1], explained[0] + 60) << "the colour of a bearing of no kind, in a gate";
  EXPECT_FALSE(std::filesystem::exists(file() + ".part"));
}

TEST_F(PipelinePicture, WithoutOdometryItShowsWhatWasSeen) {
  EXPECT_EQ(play(false), 0U);
  const ImageView drawn = picture();
  ASSERT_EQ(drawn.format.width_px, kWidth_px + 2 * Canvas::kMargin_px);
  const auto unexplained = colour_at(drawn, kWidth_px / 2 + 30, kHeight_px / 2);
  EXPECT_GT(unexplained[0], unexplained[1] + 60) << "magenta: nothing was expected";
}

TEST(Painter, AFileThatCannotBeWrittenEndsNothing) {
  PublishSettings quiet;
  quiet.lcm_url = "memq://";
  Painter painter({.rate_hz = 1.0, .file = "/dev/null/picture.jpg"}, quiet, small_camera());
  painter.paint({}, {});
  painter.paint({}, {});
  EXPECT_EQ(painter.painted(), 2U);
}

}  // namespace
}  // namespace azimuth
