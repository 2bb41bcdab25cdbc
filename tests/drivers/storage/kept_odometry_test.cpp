#include "drivers/storage/kept_odometry.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <limits>

#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

KeptOdometry some() {
  KeptOdometry kept;
  kept.clock = {
      .boot = "8ea2-77", .asleep = Duration{3'000'000}, .epoch_minus_monotonic = Duration{1'700'000'000'000'000}};
  kept.map_checksum = 0xdeadbeef;
  kept.since.map = stamp_from_us(1'700'000'100'000'000);
  kept.since.motion = {.T_start_end = {1.0, -0.25, 3.0}, .path_m = 1.5, .turned_rad = 7.0};
  kept.since.motion.covariance << 0.02, 0.001, 0.0, 0.001, 0.03, -0.002, 0.0, -0.002, 0.01;
  kept.since.reading = {.stamp = stamp_from_us(1'700'000'105'000'000),
                        .sequence = 1234,
                        .origin = 7,
                        .T_odom_body = {4.0, 5.0, -1.0},
                        .sigma_gap_m = 0.1,
                        .sigma_gap_rad = 0.2};
  kept.since.T_odom_body = {4.1, 5.1, -1.1};
  kept.odometer = {.odometer = "pioneer /dev/pioneer",
                   .robot = "name\np3dx-sh",
                   .origin = 7,
                   .at = stamp_from_us(1'700'000'105'100'000),
                   .T_odom_body = {4.2, 5.2, -1.2},
                   .numbers = {}};
  kept.odometer.numbers.fill(std::numeric_limits<std::uint64_t>::max());
  kept.odometer.put(3, -0.125);
  return kept;
}

std::vector<std::byte> encoded(const KeptOdometry& kept) {
  std::vector<std::byte> bytes;
  encode(kept, bytes);
  return bytes;
}

void expect_equal(const KeptOdometry& a, const KeptOdometry& b) {
  EXPECT_EQ(a.clock, b.clock);
  EXPECT_EQ(a.map_checksum, b.map_checksum);
  EXPECT_EQ(a.since.map, b.since.map);
  EXPECT_EQ(a.since.motion.T_start_end, b.since.motion.T_start_end);
  EXPECT_EQ(a.since.motion.covariance, b.since.motion.covariance);
  EXPECT_EQ(a.since.motion.path_m, b.since.motion.path_m);
  EXPECT_EQ(a.since.motion.turned_rad, b.since.motion.turned_rad);
  EXPECT_EQ(a.since.reading, b.since.reading);
  EXPECT_EQ(a.since.T_odom_body, b.since.T_odom_body);
  EXPECT_EQ(a.odometer, b.odometer);
}

TEST(KeptOdometry, IsReadAsItWasWritten) {
  const auto back = decode_kept_odometry(encoded(some()));
  ASSERT_TRUE(back);
  expect_equal(*back, some());
  EXPECT_EQ(back->odometer.real(3), -0.125);
}

TEST(KeptOdometry, IsNotBelievedWhenAnyByteIsWrongOrMissing) {
  const std::vector<std::byte> good = encoded(some());
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::vector<std::byte> bad = good;
    bad[i] ^= std::byte{0x10};
    EXPECT_FALSE(decode_kept_odometry(bad)) << "byte " << i;
    EXPECT_FALSE(decode_kept_odometry(Bytes(good).first(i)));
  }
}

TEST(KeptOdometry, IsNotBelievedWhenItCannotBeTrue) {
  const auto refused = [](auto change) {
    KeptOdometry kept = some();
    change(kept);
    return !decode_kept_odometry(encoded(kept));
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(refused([](KeptOdometry&) {}));
  EXPECT_TRUE(refused([](KeptOdometry& kept) { kept.since.motion.T_start_end.x_m = kNan; }));
  EXPECT_TRUE(refused([](KeptOdometry& kept) { kept.since.motion.covariance(1, 1) = kNan; }));
  EXPECT_TRUE(refused([](KeptOdometry& kept) { kept.since.motion.covariance(1, 1) = -0.01; }));
  EXPECT_TRUE(refused([](KeptOdometry& kept) { kept.since.motion.covariance(1, 0) = 1.0; })) << "not one at all";
  EXPECT_TRUE(refused([](KeptOdometry& kept) { kept.since.motion.path_m = -1.0; }));
  EXPECT_TRUE(refused([](KeptOdometry& kept) { kept.since.reading.stamp = Stamp::max(); }));
  EXPECT_TRUE(refused([](KeptOdometry& kept) { kept.since.reading.sigma_gap_rad = kNan; }));
  EXPECT_TRUE(refused([](KeptOdometry& kept) { kept.odometer.T_odom_body.heading_rad = 1e300; }));
}

TEST(KeptOdometry, CutsWhatIsTooLong) {
  KeptOdometry kept = some();
  kept.odometer.robot.assign(1000, 'x');
  const auto back = decode_kept_odometry(encoded(kept));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->odometer.robot, std::string(192, 'x'));
}

TEST(KeptOdometry, IsReadFromItsFileAsFarAsItIsThere) {
  const test::TemporaryFolder folder;
  const auto file = kept_odometry_file(folder.path() / "map.azmap");
  EXPECT_EQ(file.filename(), "map.azmap.odometry");
  EXPECT_FALSE(read_kept_odometry(file)[0]);
  KeptOdometry second = some();
  second.map_checksum = 99;
  std::vector<std::byte> bytes = encoded(some());
  const std::vector<std::byte> more = encoded(second);
  bytes.insert(bytes.end(), more.begin(), more.end());
  const auto write = [&](std::size_t begin, std::size_t size) {
    std::vector<std::byte> part(bytes.size());
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(begin), size,
                part.begin() + static_cast<std::ptrdiff_t>(begin));
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(part.data()), static_cast<std::streamsize>(begin + size));
  };
  write(0, bytes.size());
  KeptRecords both = read_kept_odometry(file);
  ASSERT_TRUE(both[0] && both[1]);
  expect_equal(*both[0], some());
  expect_equal(*both[1], second);
  write(0, bytes.size() - 1);
  both = read_kept_odometry(file);
  EXPECT_TRUE(both[0] && !both[1]) << "half a second one";
  write(more.size(), more.size());
  both = read_kept_odometry(file);
  EXPECT_TRUE(!both[0] && both[1]) << "no first one";
  write(0, 0);
  both = read_kept_odometry(file);
  EXPECT_FALSE(both[0] || both[1]);
}

TEST(KeptOdometryOnAClock, IsDatedAnewWhenTheWallClockWasSet) {
  StampClock clock = some().clock;
  clock.epoch_minus_monotonic -= Duration{3'600'000'000};
  const auto dated = on_clock(some(), clock);
  ASSERT_TRUE(dated);
  EXPECT_EQ(dated->since.reading.stamp, some().since.reading.stamp - Duration{3'600'000'000});
  EXPECT_EQ(dated->odometer.at, some().odometer.at - Duration{3'600'000'000});
  EXPECT_EQ(dated->since.map, some().since.map) << "as the map has it";
  EXPECT_EQ(dated->clock, clock);
}

TEST(KeptOdometryOnAClock, MeansNothingAfterTheMachineWasOffOrSlept) {
  StampClock clock = some().clock;
  clock.boot = "another";
  EXPECT_FALSE(on_clock(some(), clock));
  clock = some().clock;
  clock.asleep += Duration{5'000'000};
  EXPECT_FALSE(on_clock(some(), clock));
  clock.asleep = some().clock.asleep + Duration{50};
  EXPECT_TRUE(on_clock(some(), clock));
}

}  // namespace
}  // namespace azimuth
