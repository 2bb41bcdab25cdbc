// Replays a run with a few rendered images, with a front end whose output is easy to predict.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/evaluate/report.hpp"
#include "tools/replay/picture_folder.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay/replay_record.hpp"
#include "tools/replay/summary.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

/// Reports one bearing of a landmark that the robot passes. A checksum of the pixels shifts it slightly, so that each
/// image gives a different bearing.
class Checksum final : public Perception {
 public:
  explicit Checksum(PixelFormat expected) : expected_(expected) {}

  void observe(const ImageView& image, BearingSet& out) override {
    EXPECT_TRUE(image.readable());
    EXPECT_EQ(image.format.pixels, expected_);
    std::uint32_t sum = 1;
    for (const std::byte byte : image.bytes) sum = 31 * sum + std::to_integer<std::uint32_t>(byte);
    out.clear();
    out.bearings.push_back({.azimuth_rad = 0.5 + 0.05 * images_++ + 1e-5 * (sum % 1000), .identity = 0});
  }

 private:
  PixelFormat expected_;
  int images_ = 0;
};

/// Reports that every image is dark.
class Blind final : public Perception {
 public:
  void observe(const ImageView&, BearingSet& out) override {
    out.clear();
    out.trouble = ImageTrouble::dark;
  }
};

ImageFrontEnd checksum(PixelFormat pixels = PixelFormat::rgb8) { return {std::make_unique<Checksum>(pixels), pixels}; }

class ReplayImages : public testing::Test {
 protected:
  ReplayImages() {
    Scenario scenario = lab(1, 1);
    const Eigen::Vector2d start = scenario.path[0], ahead = (scenario.path[1] - start).normalized();
    scenario.path = {start, start + 0.8 * ahead};
    FileResult<azimuth::Run> rendered = rendered_run(scenario, {.quality = 60}, folder_.path());
    if (!rendered) throw std::runtime_error(text(rendered.error()));
    run_ = *std::move(rendered);
    run_.frames.resize(std::min<std::size_t>(run_.frames.size(), 8));
    rig_.camera.image.width_px = 1024;
    rig_.camera.image.height_px = 768;
    rig_.camera.identities = true;
  }

  ReplayResult replayed(ImageFrontEnd front_end) const {
    return replay_images(run_, rig_, std::move(front_end), make_ekf_estimator(rig_, EkfSettings{}), StageSettings{});
  }
  fs::path file_of(std::size_t frame) const { return run_.folder / run_.frames.at(frame).file; }
  std::string summary_of(const ReplayResult& result) const {
    return summary(run_, result, evaluate(replay_record(run_, rig_, "ekf", 1, result)));
  }

  test::TemporaryFolder folder_;
  azimuth::Run run_;
  Rig rig_;
};

TEST_F(ReplayImages, EveryImageMakesAStep) {
  ASSERT_EQ(run_.frames.size(), 8u);
  const ReplayResult result = replayed(checksum());
  ASSERT_EQ(result.estimates.size(), run_.frames.size());
  for (std::size_t i = 0; i < run_.frames.size(); ++i) EXPECT_EQ(result.estimates[i].stamp, run_.frames[i].stamp);
  EXPECT_EQ(result.images.images, 8u);
  EXPECT_TRUE(result.images.troubles.empty());
  EXPECT_EQ(result.times.detect_us.size(), 8u);
  EXPECT_EQ(result.times.decode_us.size(), 8u);
  EXPECT_EQ(result.last.input.bearing_gaps, 0u);
}

TEST_F(ReplayImages, StepsTakeAsLongAsTheirImages) {
  const ReplayResult result = replayed(checksum());
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_GE(result.times.step_us[i], result.times.detect_us[i] + result.times.decode_us[i]);
}

TEST_F(ReplayImages, GiveTheSameBitsEveryTimeAndOthersWithOtherPixels) {
  const std::uint64_t digest = replayed(checksum()).digest;
  EXPECT_EQ(replayed(checksum()).digest, digest);
  EXPECT_NE(replayed(checksum(PixelFormat::gray8)).digest, digest);
}

TEST_F(ReplayImages, BearingsOnceFoundGiveTheSameEstimates) {
  SeenSets sets(run_, rig_.camera.image, checksum());
  azimuth::Run found = run_;
  found.frames.clear();
  for (BearingSet set; sets.next(set);) found.bearings.push_back(set);
  const ReplayResult result = replay(found, rig_, make_ekf_estimator(rig_, EkfSettings{}), StageSettings{});
  EXPECT_EQ(result.digest, replayed(checksum()).digest);
  EXPECT_EQ(result.images.images, 0u);
}

TEST_F(ReplayImages, OfALogGiveTheSameEstimates) {
  fs::remove(file_of(5));
  const std::uint64_t digest = replayed(checksum()).digest;
  const fs::path log = folder_ / "run.lcm", again = folder_ / "again";
  ASSERT_TRUE(write_run_log(run_, log));
  run_ = load_run(log).operator*();
  ASSERT_EQ(run_.frames.size(), 8u);
  const ReplayResult from_log = replayed(checksum());
  EXPECT_EQ(from_log.digest, digest);
  EXPECT_EQ(from_log.images.troubles.at(ImageTrouble::unreadable), 1u);
  ASSERT_TRUE(write_run_folder(run_, again));
  run_ = load_run(again).operator*();
  EXPECT_EQ(replayed(checksum()).digest, digest);
}

TEST_F(ReplayImages, GoOnAfterFramesThatCannotBeRead) {
  fs::remove(file_of(1));
  fs::resize_file(file_of(3), fs::file_size(file_of(3)) / 2);
  std::ofstream(file_of(4)) << "not an image";
  std::ofstream(file_of(6)).flush();  // empties the file
  const ReplayResult result = replayed(checksum());
  EXPECT_EQ(result.estimates.size(), 8u);
  EXPECT_EQ(result.images.troubles.at(ImageTrouble::unreadable), 4u);
  EXPECT_EQ(result.times.detect_us.size(), 4u);
  EXPECT_NE(result.images.first_unreadable.find(run_.frames[1].file), std::string::npos);
  EXPECT_NE(summary_of(result).find("4 times the camera's images cannot be read (first: " + run_.frames[1].file),
            std::string::npos)
      << summary_of(result);
}

TEST_F(ReplayImages, PicturesShowEveryNthImageAndChangeNothing) {
  fs::resize_file(file_of(3), 10);  // the truncated image is drawn black
  const fs::path folder = folder_.path() / "pictures";
  fs::create_directory(folder);
  PictureFolder pictures(run_, rig_.camera, folder, 3);
  const auto draw = [&](const BearingSet& set, const Estimator& estimator) { pictures.before_update(set, estimator); };
  const ReplayResult drawn =
      replay_images(run_, rig_, checksum(), make_ekf_estimator(rig_, EkfSettings{}), StageSettings{}, {},
                    Ending::as_in_the_daemon, {.before_update = draw, .after_step = {}});
  EXPECT_EQ(drawn.digest, replayed(checksum()).digest);
  EXPECT_EQ(pictures.problem(), "");
  EXPECT_EQ(pictures.written(), 3u);
  for (const char* const name : {"000000.jpg", "000003.jpg", "000006.jpg"}) {
    azimuth::Run as_run;
    as_run.folder = folder;
    as_run.frames.push_back({Stamp{}, name});
    RunImages images(as_run);
    EXPECT_EQ(images.pixels(0, PixelFormat::rgb8).format.width_px, 1024 + 2 * Canvas::kMargin_px) << images.problem();
  }
}

TEST_F(ReplayImages, PicturesThatCannotBeWrittenAreNamed) {
  PictureFolder pictures(run_, rig_.camera, folder_.path() / "nowhere", 1);
  BearingSet set{.stamp = run_.frames[2].stamp, .sequence = 2, .bearings = {}};
  pictures.before_update(set, *make_ekf_estimator(rig_, EkfSettings{}));
  EXPECT_NE(pictures.problem().find("nowhere/000002.jpg"), std::string::npos) << pictures.problem();
  EXPECT_EQ(pictures.written(), 0u);
}

TEST_F(ReplayImages, OfAnotherSizeAreNotLookedAt) {
  rig_.camera.image.height_px = 767;
  const ReplayResult result = replayed(checksum());
  EXPECT_EQ(result.images.troubles.at(ImageTrouble::unreadable), 8u);
  EXPECT_TRUE(result.times.detect_us.empty());
  EXPECT_NE(result.images.first_unreadable.find("is 1024 x 768, but the rig's camera gives 1024 x 767"),
            std::string::npos);
}

TEST_F(ReplayImages, OfNoUseAreCountedApart) {
  fs::remove(file_of(0));
  const ReplayResult result = replayed({std::make_unique<Blind>(), PixelFormat::gray8});
  EXPECT_EQ(result.images.troubles.at(ImageTrouble::dark), 7u);
  const Report report = evaluate(replay_record(run_, rig_, "ekf", 1, result));
  EXPECT_EQ(report.images.images, 8u);
  EXPECT_EQ(report.images.unreadable, 1u);
  EXPECT_EQ(report.images.of_no_use, 7u);
  EXPECT_NE(summary_of(result).find("7 times the camera's images are dark"), std::string::npos);
}

TEST_F(ReplayImages, RigOfTheRenderedRunFitsItsImages) {
  const FileResult<Rig> rig = read_rig(run_.rig_toml, "rig.toml");
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(rig->front_end, FrontEnd::colour);
  EXPECT_EQ(rig->camera.image.width_px, 1024);
  EXPECT_EQ(rig->camera.image.height_px, 768);
}

}  // namespace
}  // namespace azimuth
