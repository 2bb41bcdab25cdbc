// Tests the tracks of bearings without identities: each track must follow one landmark, even if the rig is wrong.

#include "tools/drive_fit/eye_tracks.hpp"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <map>

#include "tests/support/by_kind.hpp"
#include "tests/support/drive_of.hpp"
#include "tests/support/spoilt_run.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

constexpr double kImages_s = 0.4;

Drive looking(const std::vector<std::vector<Bearing>>& images) {
  Drive drive;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Stamp stamp{duration_from_seconds(kImages_s * static_cast<double>(i))};
    drive.odometry.push_back({stamp, i, 0, {}});
    drive.sets.push_back({.stamp = stamp, .sequence = i, .bearings = images[i]});
  }
  return drive;
}

Bearing seen(double azimuth_rad, Kind kind) {
  Bearing bearing;
  bearing.azimuth_rad = wrap(azimuth_rad);
  bearing.kind = kind;
  return bearing;
}

Identity name_in(const Drive& drive, std::size_t image, std::size_t bearing) {
  return drive.sets[image].bearings[bearing].identity;
}

/// The mean number of bearings of a track, and the share of bearings that belong to another landmark than most bearings
/// of their track.
struct Tracks {
  double length = 0.0, mixed = 0.0;
};

Tracks tracks_of(const Run& run) {
  const Rig rig = test::rig_of_run(run);
  const Drive named = test::drive_of(run, rig);
  const Drive followed = test::seen_by_kind(run, rig);
  std::map<Identity, std::map<Identity, std::size_t>> truths;
  for (std::size_t i = 0; i < named.sets.size(); ++i)
    for (std::size_t k = 0; k < named.sets[i].bearings.size(); ++k)
      if (const Identity track = name_in(followed, i, k); track != kUnknownIdentity)
        ++truths[track][name_in(named, i, k)];
  double bearings = 0.0, mixed = 0.0;
  for (const auto& [track, counts] : truths) {
    std::size_t all = 0, most = 0;
    for (const auto& [truth, count] : counts) {
      all += count;
      most = std::max(most, count);
    }
    bearings += static_cast<double>(all);
    mixed += static_cast<double>(all - most);
  }
  return {bearings / static_cast<double>(truths.size()), mixed / bearings};
}

using Change = std::function<azimuth::Run(azimuth::Run)>;

TEST(EyeTracks, AreOfOneLandmarkWhateverIsWrongWithTheRig) {
  const auto good = simulated_run(lab(71, 1));
  const std::vector<Change> changes{[](auto run) { return run; }, test::with_mirrored_azimuths,
                                    test::with_swapped_wheels,
                                    [](auto run) { return test::with_turned_camera(std::move(run), 0.5 * kPi); },
                                    [](auto run) { return test::with_late_odometry(std::move(run), 0.3); }};
  for (const auto& changed : changes) {
    const Tracks tracks = tracks_of(changed(good));
    EXPECT_GT(tracks.length, 15.0);
    EXPECT_LT(tracks.mixed, 0.01);
  }
}

TEST(EyeTracks, GoOnWhileTheRobotTurnsOnTheSpot) {
  // GIVEN two red landmarks and a blue one, a little farther apart than the robot turns between two images
  std::vector<std::vector<Bearing>> images;
  for (int i = 0; i < 12; ++i) {
    const double heading_rad = 0.7 * i;
    images.push_back({seen(0.0 - heading_rad, 0), seen(1.5 - heading_rad, 0), seen(2.5 - heading_rad, 1)});
  }
  Drive drive = looking(images);
  name_by_eye(drive, {});
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 1; i < images.size(); ++i) EXPECT_EQ(name_in(drive, i, k), name_in(drive, 0, k)) << i;
}

TEST(EyeTracks, OfTwoThatCannotBeToldApartEnd) {
  // GIVEN two landmarks of one kind whose bearings cross, and two that do not move
  std::vector<std::vector<Bearing>> images;
  for (int i = -10; i <= 10; ++i)
    images.push_back({seen(0.012 * i, 0), seen(-0.012 * i, 0), seen(2.0, 1), seen(-2.0, 2)});
  Drive drive = looking(images);
  name_by_eye(drive, {});
  const std::size_t last = images.size() - 1;
  for (std::size_t before = 0; before < 2; ++before)
    for (std::size_t after = 0; after < 2; ++after) EXPECT_NE(name_in(drive, 0, before), name_in(drive, last, after));
  EXPECT_EQ(name_in(drive, 0, 2), name_in(drive, last, 2));
}

TEST(EyeTracks, OutliveAnImageThatDoesNotShowThem) {
  std::vector<std::vector<Bearing>> images(9, {seen(0.5, 0), seen(-1.0, 1)});
  images[4].pop_back();
  Drive drive = looking(images);
  name_by_eye(drive, {});
  EXPECT_EQ(name_in(drive, 8, 1), name_in(drive, 0, 1));
}

TEST(EyeTracks, AreToldApartByLooksWhereThereAreAny) {
  // GIVEN landmarks without a kind whose descriptors differ, in a different order in each image
  std::vector<Descriptor> looks(4);
  for (std::size_t k = 0; k < looks.size(); ++k) looks[k].values[10 * k] = 200;
  std::vector<std::vector<Bearing>> images(8);
  for (auto& image : images)
    for (const double azimuth_rad : {0.0, 0.05, 0.1, 0.15}) image.push_back(seen(azimuth_rad, kAnyKind));
  Drive drive = looking(images);
  for (std::size_t i = 0; i < images.size(); ++i) {
    BearingSet& set = drive.sets[i];
    set.descriptors = looks;
    std::rotate(set.bearings.begin(), set.bearings.begin() + static_cast<std::ptrdiff_t>(i % 4), set.bearings.end());
    std::rotate(set.descriptors.begin(), set.descriptors.begin() + static_cast<std::ptrdiff_t>(i % 4),
                set.descriptors.end());
  }
  name_by_eye(drive, {});
  for (std::size_t i = 1; i < images.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(name_in(drive, i, k), name_in(drive, 0, (k + i) % 4)) << i;
}

TEST(EyeTracks, EndWhereTheRobotDroveFarBetweenTwoImages) {
  Drive drive = looking({6, {seen(0.5, 0), seen(-1.0, 1)}});
  for (std::size_t i = 3; i < 6; ++i) drive.odometry[i].T_odom_body.x_m = 1.0;
  name_by_eye(drive, {});
  EXPECT_EQ(name_in(drive, 2, 0), name_in(drive, 0, 0));
  EXPECT_NE(name_in(drive, 3, 0), name_in(drive, 2, 0));
  EXPECT_EQ(name_in(drive, 5, 0), name_in(drive, 3, 0));
}

TEST(EyeTracks, OfTwoSightingsHaveNoName) {
  Drive drive = looking({2, {seen(0.5, 0)}});
  name_by_eye(drive, {});
  EXPECT_EQ(drive.named_bearings(), 0U);
}

}  // namespace
}  // namespace azimuth
