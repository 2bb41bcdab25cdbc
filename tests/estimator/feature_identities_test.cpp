#include "slam/planar/feature_identities.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <vector>

#include "tests/association/random_descriptors.hpp"

namespace azimuth {
namespace {

constexpr double kSigmaFeature_rad = 0.01;
constexpr double kReach_m = 15.0;

struct Feature {
  Descriptor looks;
  double azimuth_rad;
};

BearingSet image_of(const std::vector<Feature>& features) {
  BearingSet image;
  for (const Feature& feature : features) {
    Bearing& bearing = image.bearings.emplace_back();
    bearing.azimuth_rad = feature.azimuth_rad;
    bearing.sigma_rad = kSigmaFeature_rad;
    image.descriptors.push_back(feature.looks);
  }
  image.neighbours.resize(features.size());
  return image;
}

class Naming : public testing::Test {
 protected:
  explicit Naming(FeatureValidation validation = FeatureValidation::geometry) : identities_(settings(validation)) {
    // Two unrelated features give every search a rival, so that nothing resembles anything else until a test says so.
    name({{random_descriptor(draws_), 3.0}, {random_descriptor(draws_), -3.0}});
  }

  static FeatureIdentities settings(FeatureValidation validation) {
    IdentitySettings settings;
    settings.validation = validation;
    return {settings, kSigmaFeature_rad, kReach_m};
  }

  std::vector<Identity> name(const std::vector<Feature>& features) { return name(image_of(features)); }
  std::vector<Identity> name(const BearingSet& image) {
    std::vector<Identity> names;
    for (const Bearing& bearing : identities_.name(image, beliefs_).bearings) names.push_back(bearing.identity);
    identities_.learn(path_m_);
    return names;
  }
  Feature again(const Feature& feature, double azimuth_rad) {
    return {seen_again(feature.looks, 8.0, draws_), azimuth_rad};
  }
  Feature feature(double azimuth_rad) { return {random_descriptor(draws_), azimuth_rad}; }

  /// Adds a landmark to the filter's map, expected at this azimuth.
  void map(Identity identity, double azimuth_rad, double sigma_rad = 0.02) {
    beliefs_.mapped.push_back({identity, azimuth_rad, sigma_rad * sigma_rad});
  }
  /// Adds an earlier bearing that the filter remembers, from another place.
  void sighted(Identity identity, const Eigen::Vector2d& from, double direction_rad) {
    beliefs_.sighted.push_back({identity, from, direction_rad, kSigmaFeature_rad * kSigmaFeature_rad, 0.0});
  }

  RandomDraws draws_{111};
  IdentityBeliefs beliefs_;
  FeatureIdentities identities_;
  double path_m_ = 0.0;
};

TEST_F(Naming, NewFeaturesGetNamesNeverGivenBefore) {
  std::set<Identity> given;
  for (int image = 0; image < 30; ++image)
    for (const Identity identity : name({feature(0.1), feature(0.2), feature(0.3)}))
      EXPECT_TRUE(given.insert(identity).second) << identity;
}

TEST_F(Naming, MappedLandmarkIsRecognisedWhereItIsExpected) {
  const Feature one = feature(0.5);
  const Identity identity = name({one})[0];
  map(identity, 0.52);
  EXPECT_EQ(name({again(one, 0.5)})[0], identity);
  EXPECT_EQ(identities_.counts().mapped, 1u);
}

TEST_F(Naming, MappedLandmarkIsNotRecognisedElsewhere) {
  const Feature one = feature(0.5);
  const Identity identity = name({one})[0];
  map(identity, 0.52);
  EXPECT_GT(name({again(one, 0.7)})[0], identity);
  EXPECT_EQ(identities_.counts().mapped, 0u);
}

TEST_F(Naming, LooksBetweenTwoLandmarksAreNew) {
  const Feature one = feature(0.5);
  const Feature twin = again(one, 0.6);
  const std::vector<Identity> names = name({one, twin});
  map(names[0], 0.5);
  map(names[1], 0.6);
  EXPECT_GT(name({again(one, 0.5)})[0], names[1]);
}

TEST_F(Naming, LooksBetweenTwoLandmarksAreOfTheOneThatCanBeThere) {
  const Feature one = feature(0.5);
  const Feature like_it{seen_again(one.looks, 20.0, draws_), 2.0};
  const std::vector<Identity> names = name({one, like_it});
  map(names[0], 0.5);
  map(names[1], 2.0);
  EXPECT_EQ(name({{seen_again(one.looks, 8.0, draws_), 0.5}})[0], names[0]);
  // GIVEN both landmarks side by side THEN neither is a rival of the other, and the more similar one is chosen
  beliefs_.mapped.back().azimuth_rad = 0.51;
  EXPECT_EQ(name({{seen_again(one.looks, 8.0, draws_), 0.5}})[0], names[0]);
}

TEST_F(Naming, ALandmarkThatCannotBeSeenFromHereIsKept) {
  const Feature one = feature(0.5);
  const Identity identity = name({one})[0];
  beliefs_.mapped.push_back({.identity = identity});
  EXPECT_NE(name({again(one, 0.5)})[0], identity);
  EXPECT_EQ(identities_.store().views_of(identity), 1);
  beliefs_.mapped.clear();
  map(identity, 0.5);
  EXPECT_EQ(name({again(one, 0.5)})[0], identity);
}

TEST_F(Naming, SeveralViewsOfOneLandmarkAreNoRivals) {
  const Feature one = feature(0.5);
  const Identity identity = name({one})[0];
  map(identity, 0.5);
  for (int view = 1; view < 5; ++view) {
    beliefs_.T_map_camera.x_m = view;  // far enough apart for a separate view
    ASSERT_EQ(name({again(one, 0.5)})[0], identity) << view;
  }
  EXPECT_EQ(identities_.store().views_of(identity), 5);
}

TEST_F(Naming, ANameStandsOnTheMostAlikeFeatureOnly) {
  const Feature one = feature(0.5);
  const Identity identity = name({one})[0];
  map(identity, 0.5);
  Feature exact = one;
  exact.azimuth_rad = 0.51;
  const std::vector<Identity> names = name({again(one, 0.5), exact, again(one, 0.49)});
  EXPECT_EQ(names[1], identity);
  EXPECT_EQ(std::set<Identity>(names.begin(), names.end()).size(), 3u);
  EXPECT_EQ(identities_.counts().outdone, 2u);
}

TEST_F(Naming, SightedFeatureMustAgreeWithEveryEarlierBearing) {
  const Feature one = feature(0.5);
  const Identity identity = name({one})[0];
  beliefs_.T_map_camera = {2.0, 0.0, 0.3};
  // From the origin the feature was seen on the left. From 2 m farther on, it lies anywhere from the left to behind.
  sighted(identity, {0.0, 0.0}, kPi / 2);
  EXPECT_EQ(name({again(one, wrap(2.5 - 0.3))})[0], identity);
  EXPECT_NE(name({again(one, wrap(1.0 - 0.3))})[0], identity);
}

TEST_F(Naming, OneEarlierBearingThatDisagreesIsEnough) {
  const Feature one = feature(0.5);
  const Identity identity = name({one})[0];
  beliefs_.T_map_camera = {2.0, 0.0, 0.0};
  sighted(identity, {0.0, 0.0}, kPi / 2);
  sighted(identity, {1.9, 0.0}, -1.7);  // from here it was seen on the right, which contradicts the bearing to the left
  EXPECT_NE(name({again(one, 2.5)})[0], identity);
}

TEST_F(Naming, WhatTheFilterHasGivenUpIsForgotten) {
  const Feature one = feature(0.5);
  const Identity old = name({one})[0];
  const Identity fresh = name({again(one, 0.5)})[0];  // the feature is neither mapped nor sighted any more
  EXPECT_GT(fresh, old);
  EXPECT_EQ(identities_.store().views_of(old), 0);
  map(fresh, 0.5);
  EXPECT_EQ(name({again(one, 0.5)})[0], fresh) << "the old name is no rival";
}

TEST_F(Naming, RefusedSightingsTeachNothing) {
  const Feature one = feature(0.5);
  identities_.name(image_of({one}), beliefs_);
  const std::size_t before = identities_.store().views();
  identities_.refuse(2);  // the third identity, after those of the two unrelated features
  identities_.learn(path_m_);
  EXPECT_EQ(identities_.store().views(), before);
}

TEST_F(Naming, ImageWithoutLooksStaysUnnamed) {
  BearingSet image = image_of({feature(0.5), feature(0.6)});
  image.descriptors.clear();
  EXPECT_EQ(name(image), (std::vector<Identity>{kUnknownIdentity, kUnknownIdentity}));
  EXPECT_TRUE(name(std::vector<Feature>{}).empty());
}

TEST_F(Naming, CrowdedImagesCountForLess) {
  std::vector<Feature> many;
  for (int k = 0; k < 40; ++k) many.push_back(feature(0.1 * k - 2.0));
  const std::vector<Identity> names = name(many);
  for (std::size_t k = 0; k < many.size(); ++k) map(names[k], many[k].azimuth_rad);
  std::ranges::sort(beliefs_.mapped, std::less{}, &IdentityBeliefs::Mapped::identity);
  const BearingSet& few = identities_.name(image_of({many[0], many[1]}), beliefs_);
  EXPECT_DOUBLE_EQ(few.bearings[0].sigma_rad, kSigmaFeature_rad);
  const BearingSet& crowd = identities_.name(image_of(many), beliefs_);
  // 40 bearings together carry the information of 10
  EXPECT_DOUBLE_EQ(crowd.bearings[0].sigma_rad, 2.0 * kSigmaFeature_rad);
}

class NamingByPatterns : public Naming {
 protected:
  NamingByPatterns() : Naming(FeatureValidation::patterns) {}

  /// An image of a feature with five neighbours.
  BearingSet surrounded(const Feature& feature, const std::vector<Descriptor>& neighbours) {
    std::vector<Feature> features{feature};
    for (const Descriptor& neighbour : neighbours) features.push_back({neighbour, 1.0});
    BearingSet image = image_of(features);
    image.neighbours[0].index = {1, 2, 3, 4, 5};
    return image;
  }
  std::vector<Descriptor> five() {
    std::vector<Descriptor> neighbours;
    for (int k = 0; k < 5; ++k) neighbours.push_back(random_descriptor(draws_));
    return neighbours;
  }
};

TEST_F(NamingByPatterns, TwoNeighboursSeenAgainConfirm) {
  const Feature one = feature(0.5);
  const std::vector<Descriptor> before = five();
  const Identity identity = name(surrounded(one, before))[0];
  sighted(identity, {0.0, 0.0}, 0.5);
  std::vector<Descriptor> now = five();
  now[0] = seen_again(before[3], 8.0, draws_);
  EXPECT_NE(name(surrounded(again(one, 0.5), now))[0], identity) << "one is not enough";
  now[4] = seen_again(before[1], 8.0, draws_);
  EXPECT_NE(identity, kUnknownIdentity);
  beliefs_.sighted.clear();
  const Feature other = feature(0.9);
  const Identity second = name(surrounded(other, before))[0];
  sighted(second, {0.0, 0.0}, 0.9);
  EXPECT_EQ(name(surrounded(again(other, 0.9), now))[0], second);
}

}  // namespace
}  // namespace azimuth
