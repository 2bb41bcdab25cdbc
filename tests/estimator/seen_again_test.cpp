// Evidence for or against the pose from landmarks seen again or missed, when an image shows only a part of the
// landmarks.

#include "slam/lost/seen_again.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

#include "slam/lost/lost_robot.hpp"

namespace azimuth {
namespace {

constexpr int kOnMap = 200, kImagesToLearn = 100, kInImage = 60;
constexpr double kBetweenImages_m = 0.2, kGateShare = 0.03;

/// A drive past landmarks. A few are in sight at a time, and most images show them while they are in sight.
class DrivePast {
 public:
  struct Place {
    int in_sight = 10;
    double seen = 0.8;  ///< Probability that an image shows a landmark in sight
    int bearings = kInImage;
    double by_accident = 0.0;  ///< Probability of a false sighting of any landmark
  };

  /// Drives on to the next image, gives its evidence to the watch and returns it as log odds.
  double look(const Place& place) {
    path_m_ += kBetweenImages_m;
    const int first = static_cast<int>(path_m_ / 0.4);  // one landmark goes out of sight in every other image
    std::vector<Look> looks;
    for (int i = 0; i < kOnMap; ++i) {
      const bool in_sight = (i - first % kOnMap + kOnMap) % kOnMap < place.in_sight;
      const bool seen = chance(in_sight ? place.seen : 0.0) || chance(place.by_accident);
      looks.push_back({i, 10, seen, kGateShare});
    }
    if (watch_.doubts())
      again_.pass_over();
    else
      again_.learn();
    const double log_odds = again_.weigh(looks, path_m_, place.bearings);
    watch_.add({.expected = static_cast<int>(std::lround(again_.expected())), .log_odds = log_odds});
    return log_odds;
  }
  void learn(const Place& place) {
    for (int image = 0; image < kImagesToLearn; ++image) {
      look(place);
      EXPECT_FALSE(watch_.is_lost()) << image;
    }
  }
  /// The number of such images until the robot counts as lost; at most kNever.
  static constexpr int kNever = 40;
  int images_until_lost(const Place& place) {
    for (int image = 1; image <= kNever; ++image) {
      look(place);
      if (watch_.is_lost()) return image;
    }
    return kNever;
  }
  SeenAgain& again() { return again_; }
  const AgreementWatch& watch() const { return watch_; }

 private:
  bool chance(double p) { return draw_(random_) < p; }

  SeenAgain again_;
  AgreementWatch watch_{RelocalisationSettings{}};
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> draw_{0.0, 1.0};
  double path_m_ = 0.0;
};

TEST(SeenAgain, HowOftenLandmarksAreIsLearnt) {
  DrivePast drive;
  drive.learn({});
  EXPECT_NEAR(drive.again().probability(10, 0.0, kBetweenImages_m), 0.75, 0.1);  // one in twenty has gone out of sight
  EXPECT_LT(drive.again().probability(10, 5.0, 5.0 * kBetweenImages_m), 0.3);
  EXPECT_LT(drive.again().probability(10, 100.0, 100.0), 0.02) << "what was not seen for long is not missed";
}

TEST(SeenAgain, FewThatAreAreEnough) {
  DrivePast drive;
  drive.learn({});
  for (int image = 0; image < 50; ++image) {
    drive.look({.seen = 0.25});  // three of the ten in sight, out of 200 on the map
    EXPECT_FALSE(drive.watch().is_lost()) << image;
  }
}

TEST(SeenAgain, NoneOfThemAmongOtherThingsIsBeingLost) {
  DrivePast drive;
  drive.learn({});
  EXPECT_LE(drive.images_until_lost({.seen = 0.0}), 10);
}

TEST(SeenAgain, ByAccidentNowAndThenIsBeingLostAllTheSame) {
  DrivePast drive;
  drive.learn({});
  EXPECT_LE(drive.images_until_lost({.seen = 0.0, .by_accident = 0.001}), 15);
}

TEST(SeenAgain, MissesOfFewSayLessThanThoseOfMany) {
  DrivePast few, many;
  few.learn({.in_sight = 3});
  many.learn({.in_sight = 20});
  const double of_few = few.look({.seen = 0.0});
  EXPECT_GT(of_few, 0.0);
  EXPECT_LT(of_few, many.look({.seen = 0.0}));
}

TEST(SeenAgain, MissesOfAnImageAreOneThing) {
  DrivePast drive;
  drive.learn({.in_sight = 40});
  EXPECT_LT(drive.look({.seen = 0.0}), RelocalisationSettings{}.lost_log_odds) << "one image may be poor";
}

TEST(SeenAgain, WherePoorImagesAreUsualTheySayLess) {
  DrivePast steady, flickering;
  steady.learn({});
  for (int image = 0; image < kImagesToLearn; ++image) flickering.look({.seen = image % 5 == 0 ? 0.1 : 0.8});
  EXPECT_FALSE(flickering.watch().is_lost());
  EXPECT_LT(flickering.look({.seen = 0.0}), steady.look({.seen = 0.0}));
}

TEST(SeenAgain, AnImageOfNothingSaysNothing) {
  DrivePast drive;
  drive.learn({});
  for (int image = 0; image < 5; ++image) EXPECT_EQ(drive.look({.seen = 0.0, .bearings = 0}), 0.0);
}

TEST(SeenAgain, AfterTheImagesAreForgottenNothingIsMissed) {
  DrivePast drive;
  drive.learn({});
  drive.again().forget_images();
  EXPECT_LT(drive.look({.seen = 0.0}), 0.5);
}

}  // namespace
}  // namespace azimuth
