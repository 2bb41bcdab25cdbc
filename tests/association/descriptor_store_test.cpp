#include "slam/association/descriptor_store.hpp"

#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "tests/association/random_descriptors.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

DescriptorStoreSettings small_store() {
  DescriptorStoreSettings settings;
  settings.max_views = 100;
  settings.views_per_identity = 3;
  settings.view_spacing_m = 0.5;
  settings.stable_sightings = 3;
  settings.forget_after_m = 10.0;
  return settings;
}

NearestTwo find_one(DescriptorStore& store, const Descriptor& wanted, const Eigen::Vector2d& from = {0.0, 0.0}) {
  std::vector<NearestTwo> found;
  store.find(std::span(&wanted, 1), from, found);
  return found.at(0);
}

TEST(DescriptorStore, ForgetsAllButThoseThatAreKnown) {
  RandomDraws draws(99);
  DescriptorStore store(small_store());
  for (Identity identity = 0; identity < 10; ++identity)
    store.see(identity, random_descriptor(draws), {}, {0.0, 0.0}, 0.0);
  store.forget_all_but(std::vector<SightedWithin>{{-5}, {3}, {7}, {12}});
  EXPECT_EQ(store.identities(), 2u);
  EXPECT_EQ(store.views_of(3), 1);
  EXPECT_EQ(store.views_of(7), 1);
}

TEST(DescriptorStore, EmptyStoreFindsNothing) {
  RandomDraws draws(93);
  DescriptorStore store(small_store());
  EXPECT_EQ(find_one(store, random_descriptor(draws)).nearest.identity, kUnknownIdentity);
  std::vector<NearestTwo> found(5);
  store.find({}, {0.0, 0.0}, found);
  EXPECT_TRUE(found.empty());
}

TEST(DescriptorStore, DoesNotSearchViewsFromBeyondTwiceTheViewingDistance) {
  RandomDraws draws(94);
  DescriptorStore store(small_store());
  const Descriptor looks = random_descriptor(draws);
  store.see(1, looks, {}, {0.0, 0.0}, 0.0);
  EXPECT_EQ(find_one(store, looks, {29.9, 0.0}).nearest.identity, 1);
  EXPECT_EQ(find_one(store, looks, {30.1, 0.0}).nearest.identity, kUnknownIdentity);
}

TEST(DescriptorStore, KeepsViewsFromDifferentPlacesUpToTheirNumber) {
  RandomDraws draws(95);
  DescriptorStore store(small_store());
  std::vector<Descriptor> looks;
  for (int k = 0; k < 6; ++k) looks.push_back(random_descriptor(draws));
  store.see(1, looks[0], {}, {0.0, 0.0}, 0.0);
  store.see(1, looks[1], {}, {0.3, 0.0}, 0.3);  // too near to the first view, so it replaces it
  EXPECT_EQ(store.views_of(1), 1);
  EXPECT_EQ(find_one(store, looks[1]).nearest.squared_distance, 0);
  EXPECT_NE(find_one(store, looks[0]).nearest.squared_distance, 0);
  store.see(1, looks[2], {}, {2.0, 0.0}, 2.0);
  store.see(1, looks[3], {}, {4.0, 0.0}, 4.0);
  EXPECT_EQ(store.views_of(1), 3);
  store.see(1, looks[4], {}, {4.9, 0.0}, 4.9);  // the store is full, so this view replaces the nearest one
  EXPECT_EQ(store.views_of(1), 3);
  EXPECT_EQ(find_one(store, looks[4]).nearest.squared_distance, 0);
  EXPECT_NE(find_one(store, looks[3]).nearest.squared_distance, 0);
  EXPECT_EQ(find_one(store, looks[2]).nearest.squared_distance, 0);
}

TEST(DescriptorStore, ForgetsWhatWasSeenRarelyAndLongAgo) {
  RandomDraws draws(96);
  DescriptorStore store(small_store());
  for (int k = 0; k < 3; ++k) store.see(1, random_descriptor(draws), {}, {0.0, 0.0}, k);
  store.see(2, random_descriptor(draws), {}, {0.0, 0.0}, 2.0);
  store.see(3, random_descriptor(draws), {}, {0.0, 0.0}, 8.0);
  store.forget_unstable(12.0);
  EXPECT_EQ(store.identities(), 3u);  // a limit of 10 m is not exceeded yet
  store.forget_unstable(12.5);
  EXPECT_EQ(store.views_of(2), 0);
  EXPECT_EQ(store.views_of(3), 1);
  store.forget_unstable(1e6);
  EXPECT_EQ(store.views_of(3), 0);
  EXPECT_EQ(store.views_of(1), 1);  // a stable identity is kept
  EXPECT_EQ(store.identities(), 1u);
}

TEST(DescriptorStore, IsBoundedAndGivesUpTheUnstableFirst) {
  RandomDraws draws(97);
  DescriptorStore store(small_store());
  for (int k = 0; k < 3; ++k) store.see(1, random_descriptor(draws), {}, {0.0, 0.0}, 0.0);
  for (Identity identity = 2; identity < 1000; ++identity) {
    store.see(identity, random_descriptor(draws), {}, {0.0, 0.0}, static_cast<double>(identity));
    ASSERT_LE(store.views(), 100u);
    ASSERT_EQ(store.views_of(identity), 1);
  }
  EXPECT_EQ(store.views_of(1), 1);
  EXPECT_EQ(store.views_of(900), 0);
  EXPECT_EQ(store.views_of(901), 1);  // the newest 99 identities stay beside the stable one
}

TEST(DescriptorStore, FullOfStableIdentitiesGivesUpTheOneNotSeenForLongest) {
  RandomDraws draws(98);
  DescriptorStore store(small_store());
  for (Identity identity = 0; identity < 101; ++identity)
    for (int k = 0; k < 3; ++k)
      store.see(identity, random_descriptor(draws), {}, {0.0, 0.0}, static_cast<double>(identity));
  EXPECT_EQ(store.views(), 100u);
  EXPECT_EQ(store.views_of(0), 0);
  EXPECT_EQ(store.views_of(1), 1);
  EXPECT_EQ(store.views_of(100), 1);
}

TEST(DescriptorStore, ForgottenIdentityIsNotFound) {
  RandomDraws draws(99);
  DescriptorStore store(small_store());
  const Descriptor looks = random_descriptor(draws);
  store.see(1, looks, {}, {0.0, 0.0}, 0.0);
  store.see(2, random_descriptor(draws), {}, {0.0, 0.0}, 0.0);
  store.forget(1);
  store.forget(17);  // an unknown identity
  EXPECT_EQ(find_one(store, looks).nearest.identity, 2);
  EXPECT_EQ(store.views(), 1u);
}

TEST(DescriptorStore, KeepsThePatternOfEachView) {
  RandomDraws draws(100);
  DescriptorStore store(small_store());
  std::map<Identity, Descriptor> looks;
  for (Identity identity = 0; identity < 40; ++identity) {
    looks[identity] = random_descriptor(draws);
    Pattern pattern;
    pattern.members[0] = looks[identity];
    pattern.count = 1;
    store.see(identity, looks[identity], pattern, {0.0, 0.0}, 0.0);
  }
  for (const auto& [identity, descriptor] : looks)
    EXPECT_EQ(store.pattern(find_one(store, descriptor).nearest.slot).seen()[0], descriptor);
}

TEST(DescriptorStore, SavesViewsOldestFirstAndFindsThemAgainWhenRestored) {
  RandomDraws draws(103);
  DescriptorStore store(small_store());
  std::vector<Descriptor> looks;
  for (int k = 0; k < 6; ++k) {
    looks.push_back(random_descriptor(draws));
    store.see(k % 2, looks.back(), {}, {1.0 * k, 0.0}, 50.0);
  }
  std::vector<MapView> saved, again;
  for (const Identity identity : {1, 0, 7}) store.save(identity, saved);
  ASSERT_EQ(saved.size(), 6u) << "nothing is known of 7";
  EXPECT_EQ(saved[1], (MapView{1, {3.0, 0.0}, looks[3]}));
  DescriptorStore restored(small_store());
  restored.restore(saved);
  restored.forget_unstable(1000.0);
  EXPECT_EQ(restored.views(), 6u) << "what was saved is stable";
  for (std::size_t k = 0; k < looks.size(); ++k)
    EXPECT_EQ(find_one(restored, looks[k]).nearest.identity, static_cast<Identity>(k % 2));
  for (const Identity identity : {1, 0}) restored.save(identity, again);
  EXPECT_EQ(again, saved);
}

TEST(DescriptorStore, RestoresNoMoreThanItHasRoomFor) {
  RandomDraws draws(107);
  std::vector<MapView> views;
  for (int k = 0; k < 200; ++k) views.push_back({k / 5, {0.0, 0.0}, random_descriptor(draws)});
  DescriptorStore store(small_store());
  store.restore(views);
  EXPECT_EQ(store.views(), 100u);
  for (Identity identity = 0; identity < 33; ++identity) EXPECT_EQ(store.views_of(identity), 3);
}

TEST(DescriptorStore, LooksBeyondTheViewingDistanceWhenAskedTo) {
  RandomDraws draws(109);
  DescriptorStore store(small_store());
  const Descriptor far = random_descriptor(draws);
  store.see(4, far, {}, {500.0, 0.0}, 0.0);
  EXPECT_EQ(find_one(store, far).nearest.identity, kUnknownIdentity);
  std::vector<NearestTwo> found;
  store.find(std::span(&far, 1), {0.0, 0.0}, found, true);
  EXPECT_EQ(found.at(0).nearest.identity, 4);
}

TEST(DescriptorStore, DoesNotAllocateOnceFull) {
  RandomDraws draws(101);
  DescriptorStore store(small_store());
  std::vector<Descriptor> looks;
  for (int k = 0; k < 400; ++k) looks.push_back(random_descriptor(draws));
  std::vector<NearestTwo> found;
  Identity identity = 0;
  const auto image = [&](int number) {
    store.find(std::span(looks).first(40), {0.0, 0.0}, found);
    for (std::size_t k = 0; k < 40; ++k)
      store.see(identity++, looks[(static_cast<std::size_t>(number) * 40 + k) % 400], {}, {0.0, 0.0}, number);
    store.forget_unstable(number);
  };
  for (int number = 0; number < 20; ++number) image(number);
  const std::size_t before = allocations();
  for (int number = 20; number < 60; ++number) image(number);
  EXPECT_EQ(allocations() - before, 0u);
}

}  // namespace
}  // namespace azimuth
