#include <gtest/gtest.h>

#include "sim/renderer/standard_cameras.hpp"
#include "slam/perception/make_perception.hpp"
#include "tests/perception/rendered_images.hpp"

namespace azimuth {
namespace {

/// A front end that returns one bearing for every image.
class OneBearing final : public Perception {
 public:
  explicit OneBearing(int& images) : images_(images) {}
  void observe(const ImageView& /*image*/, BearingSet& out) override {
    ++images_;
    out.clear();
    out.bearings.push_back({.azimuth_rad = 1.0});
  }

 private:
  int& images_;
};

TEST(WatchedPerception, LetsGoodImagesThroughAndNamesBadOnes) {
  int images = 0;
  const ImageRig rig = standard_camera("mirror")->image;
  WatchedPerception watched(std::make_unique<OneBearing>(images), ImageWatch(rig));
  const test::Image room = test::mirror_image(), black = test::blank(PixelFormat::gray8, 1024, 768);
  BearingSet set;
  set.sequence = 7;

  watched.observe(room.view(), set);
  EXPECT_EQ(set.trouble, ImageTrouble::none);
  EXPECT_EQ(set.bearings.size(), 1U);
  watched.observe(black.view(), set);
  EXPECT_EQ(set.trouble, ImageTrouble::dark);
  EXPECT_TRUE(set.bearings.empty());
  watched.observe({}, set);
  EXPECT_EQ(set.trouble, ImageTrouble::unreadable);
  watched.observe(room.view(), set);
  EXPECT_EQ(set.trouble, ImageTrouble::none) << "trouble ends with its image";
  EXPECT_EQ(set.bearings.size(), 1U);
  EXPECT_EQ(set.sequence, 7U) << "the caller's";
  EXPECT_EQ(images, 2) << "the front end sees good images only";
}

TEST(WatchedPerception, DropsWhatRepeatsItself) {
  int images = 0;
  const ImageRig rig = standard_camera("mirror")->image;
  WatchedPerception watched(std::make_unique<OneBearing>(images), ImageWatch(rig, {.frozen_repeats = 3}));
  const test::Image room = test::mirror_image();
  BearingSet set;
  for (int i = 0; i < 10; ++i) watched.observe(room.view(), set);
  EXPECT_EQ(set.trouble, ImageTrouble::frozen);
  EXPECT_TRUE(set.bearings.empty());
  EXPECT_EQ(images, 3);
}

TEST(WatchedPerception, IsWhatEveryFrontEndComesWith) {
  const std::unique_ptr<Perception> sift = make_perception(FrontEnd::sift, *standard_camera("mirror"), {});
  ASSERT_TRUE(sift);
  BearingSet set;
  sift->observe(test::blank(PixelFormat::gray8, 1024, 768).view(), set);
  EXPECT_EQ(set.trouble, ImageTrouble::dark);
  sift->observe(test::mirror_image().view(), set);
  EXPECT_EQ(set.trouble, ImageTrouble::none);
  EXPECT_FALSE(set.bearings.empty());
}

}  // namespace
}  // namespace azimuth
