// The searches of a DescriptorStore compared with an exhaustive search over all views.

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

#include "slam/association/descriptor_store.hpp"
#include "slam/geometry/angle.hpp"
#include "tests/association/random_descriptors.hpp"

namespace azimuth {
namespace {

/// Settings that keep every view, however near its place is to that of another view.
DescriptorStoreSettings every_view() {
  DescriptorStoreSettings settings;
  settings.view_spacing_m = 0.0;
  settings.views_per_identity = 100;
  return settings;
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

TEST(DescriptorSearch, FindsWhatAFullSearchFinds) {
  RandomDraws draws(92);
  DescriptorStore store(every_view());
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
  for (int k = 0; k < 37; ++k)  // not a multiple of the number of queries searched at once
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

TEST(DescriptorSearch, FindsWhatCanBeThereAndItsRivalsElsewhere) {
  RandomDraws draws(97);
  DescriptorStore store(every_view());
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

TEST(DescriptorSearch, WhereEverythingCanBeIdentitiesAreEachOthersRivals) {
  RandomDraws draws(98);
  DescriptorStore store({});
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

}  // namespace
}  // namespace azimuth
