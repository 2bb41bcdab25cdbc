#include "tools/replay_page/page_pictures.hpp"

#include <gtest/gtest.h>

#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

/// A run of eight rendered images, whose steps have the given health.
class PagePicturesOfARun : public testing::Test {
 protected:
  PagePicturesOfARun() {
    Scenario scenario = lab(1, 1);
    const Eigen::Vector2d start = scenario.path[0], ahead = (scenario.path[1] - start).normalized();
    scenario.path = {start, start + 0.8 * ahead};
    FileResult<azimuth::Run> rendered = rendered_run(scenario, {.quality = 60}, folder_.path());
    if (!rendered) throw std::runtime_error(text(rendered.error()));
    run_ = *std::move(rendered);
    run_.frames.resize(std::min<std::size_t>(run_.frames.size(), 8));
    rig_.camera.image.width_px = 1024;
    rig_.camera.image.height_px = 768;
  }

  void show(PagePictures& pictures, const std::vector<Health>& healths) const {
    const auto estimator = make_ekf_estimator(rig_, EkfSettings{});
    for (std::size_t i = 0; i < run_.frames.size(); ++i) {
      pictures.before_update({.stamp = run_.frames[i].stamp, .sequence = i, .bearings = {}}, *estimator);
      Estimate estimate;
      estimate.health = healths[i % healths.size()];
      estimate.reason = estimate.health == Health::lost ? "nobody knows" : "";
      pictures.after_step(estimate);
    }
  }

  test::TemporaryFolder folder_;
  azimuth::Run run_;
  Rig rig_;
};

TEST_F(PagePicturesOfARun, AreSpreadEvenly) {
  PagePictures pictures(run_, rig_.camera, {.pictures = 3, .bytes = 1'000'000});
  show(pictures, {Health::starting});
  ASSERT_EQ(pictures.pictures().size(), 2u);  // one third is kept for changes of the health
  EXPECT_EQ(pictures.pictures()[0].stamp, run_.frames[0].stamp);
  EXPECT_EQ(pictures.pictures()[1].stamp, run_.frames[4].stamp);
  EXPECT_EQ(pictures.pictures()[0].why, "");
}

TEST_F(PagePicturesOfARun, ShowWhereHealthChangesAsFarAsThereIsRoom) {
  PagePictures pictures(run_, rig_.camera, {.pictures = 6, .bytes = 1'000'000});
  using enum Health;
  show(pictures, {starting, starting, starting, lost, starting, lost, starting, lost});
  std::vector<std::string> reasons;
  for (const PagePicture& picture : pictures.pictures())
    if (!picture.why.empty()) reasons.push_back(picture.why);
  EXPECT_EQ(reasons, (std::vector<std::string>{"lost: nobody knows", "starting"}));
  EXPECT_LE(pictures.pictures().size(), 6u);
}

TEST_F(PagePicturesOfARun, StayWithinTheirBytes) {
  for (const std::size_t bytes : {400'000u, 90'000u, 45'000u}) {
    PagePictures pictures(run_, rig_.camera, {.pictures = 3, .bytes = bytes});
    show(pictures, {Health::starting});
    EXPECT_EQ(pictures.pictures().size(), 2u);
    for (const PagePicture& picture : pictures.pictures()) EXPECT_LE(picture.jpeg.size(), bytes / 3);
  }
  PagePictures impossible(run_, rig_.camera, {.pictures = 3, .bytes = 30});
  show(impossible, {Health::starting});
  EXPECT_TRUE(impossible.pictures().empty());
}

TEST_F(PagePicturesOfARun, NoneAreDrawnWhereNoneAreWanted) {
  PagePictures pictures(run_, rig_.camera, {.pictures = 0, .bytes = 1'000'000});
  show(pictures, {Health::starting, Health::lost});
  EXPECT_TRUE(pictures.pictures().empty());
}

}  // namespace
}  // namespace azimuth
