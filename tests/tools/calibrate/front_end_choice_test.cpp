#include "tools/calibrate/front_end_choice.hpp"

#include <gtest/gtest.h>

#include "drivers/camera/run_images.hpp"
#include "drivers/storage/run.hpp"
#include "settings/rig.hpp"
#include "tests/support/places.hpp"

namespace azimuth {
namespace {

TEST(FrontEndChoice, IsColourWhereMostImagesFixAPoseByIt) {
  EXPECT_EQ(front_end_for({{3, 5, 2}, {}, {}}), FrontEnd::colour);
  EXPECT_EQ(front_end_for({{3, 2, 2}, {90, 90, 90}, {0, 0, 0}}), FrontEnd::sift);
  EXPECT_EQ(front_end_for({{3, 2}, {}, {}}), FrontEnd::sift) << "half of them are not most";
  EXPECT_EQ(front_end_for({}), FrontEnd::sift);
}

TEST(FrontEndChoice, IsDoubtfulWhereHardlyAnythingIsSeenAgain) {
  EXPECT_TRUE(is_doubtful({{0, 0, 0}, {90, 90, 90}, {40, 2, 1}}));
  EXPECT_FALSE(is_doubtful({{0, 0, 0}, {90, 90, 90}, {40, 5, 1}}));
  EXPECT_FALSE(is_doubtful({{4, 4, 4}, {90, 90, 90}, {0, 0, 0}})) << "colours do";
  EXPECT_FALSE(is_doubtful({})) << "of which nothing is known";
}

TEST(FrontEndChoice, SaysWhy) {
  EXPECT_EQ(reason({{4, 1, 5}, {80, 90, 70}, {12, 9, 30}}),
            "3 or more coloured landmarks are seen in 2 of 3 images and again in the next; of 80 features 12 are");
  EXPECT_EQ(reason({}), "a single image does not say what is seen again");
}

class MirrorDrive : public testing::Test {
 protected:
  MirrorDrive() : run_(*load_run(test::source_folder() / "runs/mirror")), images_(run_) {}

  /// Tries the front ends on the first eight images in the format `decoded`. Each one is paired with the image that is
  /// `later_by` frames later.
  FrontEndsSeenAgain seen(PixelFormat decoded, std::size_t later_by) {
    FrontEndTrial trial(read_rig(run_.rig_toml, run_.rig_file)->camera);
    for (std::size_t i = 0; i < 8; ++i) {
      const ImageView image = images_.pixels(i, decoded);
      const std::vector<std::byte> earlier(image.bytes.begin(), image.bytes.end());
      trial.add({image.format, earlier}, images_.pixels(i + later_by, decoded));
    }
    return trial.seen();
  }

  azimuth::Run run_;
  RunImages images_;
};

TEST_F(MirrorDrive, OfColouredLandmarksIsForColours) {
  EXPECT_EQ(front_end_for(seen(PixelFormat::rgb8, 1)), FrontEnd::colour);
}

TEST_F(MirrorDrive, WithoutColoursIsForFeatures) {
  const FrontEndsSeenAgain grey = seen(PixelFormat::gray8, 1);
  EXPECT_EQ(grey.coloured, std::vector<int>(8, 0));
  EXPECT_EQ(front_end_for(grey), FrontEnd::sift);
}

TEST_F(MirrorDrive, SeesEveryFeatureOfAnImageAgainInTheSameOne) {
  const FrontEndsSeenAgain same = seen(PixelFormat::gray8, 0);
  for (std::size_t i = 0; i < same.features.size(); ++i) {
    EXPECT_GT(same.features[i], 20);
    EXPECT_GE(same.features_again[i], same.features[i] * 9 / 10) << "but for those that have a double";
  }
  const FrontEndsSeenAgain far = seen(PixelFormat::gray8, 6);
  for (std::size_t i = 0; i < far.features.size(); ++i) EXPECT_LT(far.features_again[i], far.features[i] / 3);
}

}  // namespace
}  // namespace azimuth
