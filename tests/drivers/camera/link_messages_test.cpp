#include "drivers/camera/link_messages.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <rapidcheck/gtest.h>

#include "drivers/wire/plausible.hpp"
#include "tests/drivers/camera/link_fixture.hpp"

namespace azimuth::camera_link {
namespace {

using Buffer = std::vector<std::byte>;

const Hello kGray{test::kSmallGray, 4096, 4};
const Hello kJpeg{packed_format(PixelFormat::mjpeg, 640, 480), 8192, 2};

template <class Message>
Buffer encoded(const Message& message) {
  Buffer out;
  encode(message, out);
  return out;
}

bool same(const BearingSet& a, const BearingSet& b) {
  const auto equal = [](const Bearing& x, const Bearing& y) {
    const bool flat = std::isnan(x.elevation_rad) && std::isnan(y.elevation_rad);
    const bool of_the_rig = std::isnan(x.sigma_rad) && std::isnan(y.sigma_rad);
    return x.azimuth_rad == y.azimuth_rad && (flat || x.elevation_rad == y.elevation_rad) && x.identity == y.identity &&
           x.kind == y.kind && (of_the_rig || x.sigma_rad == y.sigma_rad) &&
           (x.sigma_elevation_rad == y.sigma_elevation_rad || std::isnan(x.sigma_elevation_rad)) &&
           (x.radius_px == y.radius_px || (std::isnan(x.radius_px) && std::isnan(y.radius_px)));
  };
  return a.stamp == b.stamp && a.sequence == b.sequence && std::ranges::equal(a.bearings, b.bearings, equal);
}

/// Passes the bytes to every decoder. Accepted messages must have valid values.
bool anything_accepted(Bytes message) {
  bool accepted = false;
  if (const auto hello = decode_hello(message)) accepted = is_valid(*hello);
  for (const Hello& hello : {kGray, kJpeg}) {
    if (const auto frame = decode_frame(message, hello)) {
      EXPECT_LT(frame->slot, hello.slots);
      EXPECT_LE(frame->bytes, hello.slot_bytes);
      accepted = true;
    }
  }
  if (const auto release = decode_release(message)) {
    EXPECT_LT(release->slot, FramePool::kMaxSlots);
    accepted = true;
  }
  BearingSet set;
  if (decode_bearings(message, set)) {
    EXPECT_LE(set.bearings.size(), kMaxBearings);
    EXPECT_TRUE(std::ranges::all_of(set.bearings, [](const Bearing& bearing) { return is_plausible(bearing); }));
    accepted = true;
  }
  EXPECT_LE(set.bearings.capacity(), 2 * kMaxBearings) << "a claimed count must not allocate";
  return accepted;
}

const std::vector<Buffer> kGood{encoded(kGray),
                                encoded(kJpeg),
                                encoded(Hello{}),
                                encoded(FrameMessage{2, 77, stamp_from_us(123), kGray.slot_bytes * 3 / 4}),
                                encoded(Release{1, 99}),
                                encoded(test::set_of(5, 3)),
                                encoded(test::set_of(6, 0))};

TEST(LinkMessages, HelloComesBack) {
  for (const Hello& hello : {kGray, kJpeg, Hello{}}) EXPECT_EQ(decode_hello(encoded(hello)), hello);
}

TEST(LinkMessages, FrameComesBack) {
  const FrameMessage frame{3, std::uint64_t{1} << 60U, stamp_from_us(-5), 64 * 48};
  EXPECT_EQ(decode_frame(encoded(frame), kGray), frame);
  const FrameMessage jpeg{1, 4, stamp_from_us(5), 8192};
  EXPECT_EQ(decode_frame(encoded(jpeg), kJpeg), jpeg);
}

TEST(LinkMessages, FrameMustFitTheHello) {
  const auto accepted = [](const FrameMessage& frame, const Hello& hello) {
    return decode_frame(encoded(frame), hello).has_value();
  };
  EXPECT_FALSE(accepted({4, 1, {}, 64 * 48}, kGray)) << "no such slot";
  EXPECT_FALSE(accepted({0, 1, {}, 64 * 48 - 1}, kGray)) << "part of an image";
  EXPECT_FALSE(accepted({0, 1, {}, 8193}, kJpeg)) << "beyond the slot";
  EXPECT_FALSE(accepted({0, 1, {}, 0}, kJpeg)) << "empty";
  EXPECT_FALSE(accepted({0, 1, {}, 0}, Hello{})) << "no slots at all";
  EXPECT_FALSE(accepted({0, 1, stamp_from_us(kMaxStamp_us + 1), 64 * 48}, kGray)) << "absurd stamp";
}

TEST(LinkMessages, HelloBounds) {
  const auto accepted = [](Hello hello) { return decode_hello(encoded(hello)).has_value(); };
  EXPECT_FALSE(accepted({kGray.format, 64 * 48 - 1, 4})) << "slot smaller than a frame";
  EXPECT_FALSE(accepted({kGray.format, 4096, FramePool::kMaxSlots + 1}));
  EXPECT_FALSE(accepted({kGray.format, static_cast<std::uint32_t>(kMaxSlotBytes), FramePool::kMaxSlots}));
  EXPECT_FALSE(accepted({kJpeg.format, 0, 2}));
  EXPECT_FALSE(accepted({kGray.format, 4096, 0})) << "a format but no slots";
  EXPECT_FALSE(accepted({packed_format(PixelFormat::gray8, -64, 48), 4096, 1}));
}

TEST(LinkMessages, AbsurdBearingsAreRefused) {
  BearingSet into;
  for (const Bearing bad :
       {Bearing{.azimuth_rad = NAN}, Bearing{.azimuth_rad = 361.0}, Bearing{.azimuth_rad = 0.0, .elevation_rad = 361.0},
        Bearing{.azimuth_rad = 0.0, .elevation_rad = INFINITY}, Bearing{.identity = -2}, Bearing{.kind = -2},
        Bearing{.sigma_rad = 0.0}, Bearing{.sigma_rad = INFINITY}, Bearing{.radius_px = -1.0},
        Bearing{.sigma_elevation_rad = 0.0}}) {
    EXPECT_FALSE(decode_bearings(encoded(BearingSet{.bearings = {Bearing{}, bad}}), into));
  }
}

RC_GTEST_PROP(LinkMessages, BearingsComeBack, (std::uint64_t sequence, std::int64_t stamp_us)) {
  BearingSet set{.stamp = stamp_from_us(stamp_us % kMaxStamp_us), .sequence = sequence, .bearings = {}};
  const auto count = *rc::gen::inRange<std::size_t>(0, kMaxBearings + 1);
  for (std::size_t i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count);
    set.bearings.push_back({.azimuth_rad = kPi * (2 * part - 1),
                            .elevation_rad = i % 3 == 0 ? NAN : 0.5 * kPi * part,
                            .identity = i % 2 == 0 ? kUnknownIdentity : static_cast<Identity>(sequence >> 1U),
                            .kind = static_cast<Kind>(i % 7) - 1,
                            .sigma_rad = i % 5 == 0 ? NAN : 0.001 + part,
                            .radius_px = 10.0 + part,
                            .sigma_elevation_rad = 0.002 + part});
  }
  BearingSet into = test::set_of(1, 5);
  const Buffer message = encoded(set);
  RC_ASSERT(message.size() <= kMaxMessageBytes);
  RC_ASSERT(decode_bearings(message, into));
  RC_ASSERT(same(into, set));
}

TEST(LinkMessages, NeitherCutNorLengthened) {
  for (const Buffer& good : kGood) {
    ASSERT_TRUE(anything_accepted(good));
    for (std::size_t length = 0; length < good.size(); ++length) {
      EXPECT_FALSE(anything_accepted(Bytes(good).first(length))) << length << " of " << good.size();
    }
    Buffer longer = good;
    longer.push_back(std::byte{0});
    EXPECT_FALSE(anything_accepted(longer));
  }
}

TEST(LinkMessages, AnyBytesAreSafe) {
  std::mt19937_64 random(1);  // NOLINT(cert-msc51-cpp): the same every time
  int accepted = 0;
  for (int i = 0; i < 200'000; ++i) {
    Buffer message = kGood[random() % kGood.size()];
    for (std::uint64_t changes = random() % 4; changes > 0 && !message.empty(); --changes) {
      message[random() % message.size()] = static_cast<std::byte>(random());
    }
    if (random() % 8 == 0) message.resize(random() % 100);
    accepted += anything_accepted(message) ? 1 : 0;
  }
  EXPECT_GT(accepted, 50'000) << "the mutations leave nothing to accept";
  EXPECT_LT(accepted, 190'000);
}

}  // namespace
}  // namespace azimuth::camera_link
