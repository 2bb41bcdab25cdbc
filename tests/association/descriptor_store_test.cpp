#include "slam/association/descriptor_store.hpp"

#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "slam/geometry/angle.hpp"
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

TEST(NearestTwo, RivalCarriesAnotherIdentity) {
  NearestTwo two;
  for (const auto& [distance2, identity] : std::vector<std::pair<int, Identity>>{{90, 3}, {35, 1}, {62, 2}, {30, 1}})
    two.add({distance2, identity, 0});
  EXPECT_EQ(two.nearest.identity, 1);
  EXPECT_EQ(two.nearest.squared_distance, 30);
  EXPECT_EQ(two.rival.identity, 2);
  EXPECT_DOUBLE_EQ(two.ratio(), std::sqrt(30.0 / 62.0));
}

TEST(NearestTwo, AgreesWithSortingInAnyOrder) {
  RandomDraws draws(91);
  for (int k = 0; k < 2000; ++k) {
    std::vector<NearestTwo::View> views;
    NearestTwo two;
    for (int i = draws.integer(1, 12); i > 0; --i)
      two.add(views.emplace_back(NearestTwo::View{draws.integer(0, 1000000), draws.integer(0, 4), 0}));
    std::ranges::stable_sort(views, std::less{}, &NearestTwo::View::squared_distance);
    EXPECT_EQ(two.nearest.squared_distance, views.front().squared_distance);
    const auto rival =
        std::ranges::find_if(views, [&](const auto& view) { return view.identity != views.front().identity; });
    EXPECT_EQ(two.rival.identity == kUnknownIdentity, rival == views.end());
    if (rival != views.end()) {
      EXPECT_EQ(two.rival.squared_distance, rival->squared_distance);
    }
  }
}

TEST(NearestTwo, RatioWithoutARivalOrWithoutADifference) {
  NearestTwo two;
  two.add({100, 1, 0});
  EXPECT_EQ(two.ratio(), 0.0);
  two.add({0, 1, 0});
  two.add({0, 2, 0});
  EXPECT_EQ(two.ratio(), 1.0);
}

TEST(DescriptorStore, FindsWhatAFullSearchFinds) {
  RandomDraws draws(92);
  DescriptorStoreSettings settings;
  settings.view_spacing_m = 0.0;
  settings.views_per_identity = 100;
  DescriptorStore store(settings);
  struct View {
    Identity identity;
    Descriptor looks;
    Eigen::Vector2d from;
  };
  std::vector<View> views;
  for (int k = 0; k < 700; ++k) {
    views.push_back(
        {draws.integer(0, 150), random_descriptor(draws), {draws.uniform(-60, 60), draws.uniform(-60, 60)}});
    store.see(views.back().identity, views.back().looks, {}, views.back().from, 0.0);
  }
  std::vector<Descriptor> wanted;
  for (int k = 0; k < 37; ++k)  // not a multiple of what is searched at once
    wanted.push_back(seen_again(views[static_cast<std::size_t>(draws.integer(0, 699))].looks, 40.0, draws));
  const Eigen::Vector2d here(10.0, -5.0);
  std::vector<NearestTwo> found;
  store.find(wanted, here, found);
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t q = 0; q < wanted.size(); ++q) {
    NearestTwo expected;
    for (const View& view : views)
      if ((view.from - here).norm() < 30.0) expected.add({squared_distance(wanted[q], view.looks), view.identity, 0});
    EXPECT_EQ(found[q].nearest.identity, expected.nearest.identity);
    EXPECT_EQ(found[q].nearest.squared_distance, expected.nearest.squared_distance);
    EXPECT_EQ(found[q].rival.identity, expected.rival.identity);
    EXPECT_EQ(found[q].rival.squared_distance, expected.rival.squared_distance);
  }
}

TEST(DescriptorStore, FindsWhatCanBeThereAndItsRivalsElsewhere) {
  RandomDraws draws(97);
  DescriptorStoreSettings settings;
  settings.view_spacing_m = 0.0;
  settings.views_per_identity = 100;
  DescriptorStore store(settings);
  std::vector<SightedWithin> within;
  for (Identity identity = 0; identity < 60; ++identity)
    within.push_back({identity, draws.uniform(-kPi, kPi), identity % 10 == 0 ? -1.0 : draws.uniform(0.0, 1.5)});
  std::vector<std::pair<Identity, Descriptor>> views;
  for (int k = 0; k < 300; ++k) {
    views.emplace_back(draws.integer(0, 59), random_descriptor(draws));
    store.see(views.back().first, views.back().second, {}, {draws.uniform(-9.0, 9.0), 0.0}, 0.0);
  }
  std::vector<Descriptor> wanted;
  std::vector<double> azimuths_rad;
  for (int k = 0; k < 53; ++k) {
    wanted.push_back(seen_again(views[static_cast<std::size_t>(draws.integer(0, 299))].second, 40.0, draws));
    azimuths_rad.push_back(draws.uniform(-kPi, kPi));
  }
  std::vector<NearestTwo> found;
  store.find_within(wanted, azimuths_rad, within, {0.0, 0.0}, found);
  int can_be_there = 0;
  for (std::size_t q = 0; q < wanted.size(); ++q) {
    NearestTwo there, elsewhere;
    for (const auto& [identity, looks] : views) {
      const SightedWithin& its = within[static_cast<std::size_t>(identity)];
      const bool can = std::abs(wrap(azimuths_rad[q] - its.azimuth_rad)) <= its.half_width_rad;
      (can ? there : elsewhere).add({squared_distance(wanted[q], looks), identity, 0});
    }
    const bool is_nearer = there.nearest.squared_distance < elsewhere.nearest.squared_distance;
    can_be_there += is_nearer ? 1 : 0;
    EXPECT_EQ(found[q].nearest.identity, is_nearer ? there.nearest.identity : kUnknownIdentity);
    EXPECT_EQ(found[q].rival.identity, elsewhere.nearest.identity);
    EXPECT_EQ(found[q].rival.squared_distance, elsewhere.nearest.squared_distance);
  }
  EXPECT_GT(can_be_there, 5);
  EXPECT_LT(can_be_there, 48);
}

TEST(DescriptorStore, WhereEverythingCanBeIdentitiesAreEachOthersRivals) {
  RandomDraws draws(98);
  DescriptorStore store(small_store());
  const Descriptor one = random_descriptor(draws), other = random_descriptor(draws);
  store.see(1, one, {}, {0.0, 0.0}, 0.0);
  store.see(2, other, {}, {0.0, 0.0}, 0.0);
  const std::vector<SightedWithin> within{{1, 0.0, kPi}, {2, 0.0, kPi}};
  std::vector<NearestTwo> found;
  store.find_within(std::vector{one}, std::vector{1.0}, within, {0.0, 0.0}, found);
  EXPECT_EQ(found.at(0).nearest.identity, 1);
  EXPECT_EQ(found.at(0).rival.identity, 2);
  EXPECT_EQ(found.at(0).rival.squared_distance, squared_distance(one, other));
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
  store.see(1, looks[1], {}, {0.3, 0.0}, 0.3);  // too near to the first: takes its place
  EXPECT_EQ(store.views_of(1), 1);
  EXPECT_EQ(find_one(store, looks[1]).nearest.squared_distance, 0);
  EXPECT_NE(find_one(store, looks[0]).nearest.squared_distance, 0);
  store.see(1, looks[2], {}, {2.0, 0.0}, 2.0);
  store.see(1, looks[3], {}, {4.0, 0.0}, 4.0);
  EXPECT_EQ(store.views_of(1), 3);
  store.see(1, looks[4], {}, {4.9, 0.0}, 4.9);  // full: takes the place of the nearest one
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
  EXPECT_EQ(store.identities(), 3u);  // 10 m are not exceeded
  store.forget_unstable(12.5);
  EXPECT_EQ(store.views_of(2), 0);
  EXPECT_EQ(store.views_of(3), 1);
  store.forget_unstable(1e6);
  EXPECT_EQ(store.views_of(3), 0);
  EXPECT_EQ(store.views_of(1), 1);  // stable
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
  EXPECT_EQ(store.views_of(901), 1);  // the newest 99 beside the stable one
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
  store.forget(17);  // never heard of
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
