#include "drivers/camera/frame.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <set>
#include <string>
#include <sys/eventfd.h>
#include <thread>
#include <vector>

namespace azimuth {
namespace {

std::shared_ptr<FramePool> pool_with_bell() {
  return std::make_shared<FramePool>(UniqueFd(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)));
}

bool rings(const FramePool& pool) {
  pollfd ready{.fd = pool.descriptor(), .events = POLLIN, .revents = 0};
  return ::poll(&ready, 1, 0) == 1;
}

const std::vector<std::byte> kPixels(12);
const FrameFormat kFormat = packed_format(PixelFormat::gray8, 4, 3);

Frame lease(const std::shared_ptr<FramePool>& pool, unsigned slot) { return {pool, slot, kFormat, kPixels}; }

TEST(Frame, ComesBackOnceWhenItDies) {
  const auto pool = pool_with_bell();
  { const Frame frame = lease(pool, 3); }
  EXPECT_TRUE(rings(*pool));
  EXPECT_EQ(pool->take_returned(), 1U << 3U);
  EXPECT_FALSE(rings(*pool));
  EXPECT_EQ(pool->take_returned(), 0U);
}

TEST(Frame, MovingKeepsTheLease) {
  const auto pool = pool_with_bell();
  {
    Frame frame = lease(pool, 0);
    frame.sequence = 7;
    Frame moved = std::move(frame);
    Frame swapped;
    swap(moved, swapped);
    EXPECT_EQ(pool->take_returned(), 0U);
    EXPECT_FALSE(moved);
    EXPECT_TRUE(swapped);
    EXPECT_EQ(swapped.sequence, 7U);
    EXPECT_EQ(swapped.format(), kFormat);
    EXPECT_EQ(swapped.bytes().size(), kFormat.bytes());
  }
  EXPECT_EQ(pool->take_returned(), 1U);
}

TEST(Frame, AssignmentReleasesWhatItReplaces) {
  const auto pool = pool_with_bell();
  Frame frame = lease(pool, 1);
  frame = lease(pool, 2);
  EXPECT_EQ(pool->take_returned(), 1U << 1U);
  frame = Frame{};
  EXPECT_EQ(pool->take_returned(), 1U << 2U);
}

TEST(Frame, OutlivesTheDriver) {
  auto pool = pool_with_bell();
  const std::weak_ptr<FramePool> life = pool;
  {
    const Frame frame = lease(pool, 0);
    pool.reset();
    EXPECT_FALSE(life.expired());
  }
  EXPECT_TRUE(life.expired());
}

TEST(Frame, ManyThreadsMayGiveBackAtOnce) {
  const auto pool = pool_with_bell();
  constexpr int kRounds = 2000;
  std::uint64_t returned = 0;
  const auto collect = [&] { returned += static_cast<std::uint64_t>(std::popcount(pool->take_returned())); };
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Frame> frames;
    for (unsigned slot = 0; slot < FramePool::kMaxSlots; ++slot) frames.push_back(lease(pool, slot));
    if (round % 100 != 0) {
      frames.clear();
    } else {
      std::vector<std::jthread> threads;
      for (unsigned slot = 0; slot < FramePool::kMaxSlots; slot += 8) {
        threads.emplace_back([&frames, slot] {
          for (unsigned i = slot; i < slot + 8; ++i) frames[i] = Frame{};
        });
      }
      collect();  // while they run
    }
    collect();
  }
  EXPECT_EQ(returned, std::uint64_t{kRounds} * FramePool::kMaxSlots);
}

TEST(FrameFormat, NamesAreDistinct) {
  std::set<std::string> names;
  for (int i = 0; i < kPixelFormats; ++i) names.insert(std::string(name(static_cast<PixelFormat>(i))));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kPixelFormats));
  EXPECT_EQ(name(PixelFormat::bayer_bggr8), "bayer_bggr8");
  EXPECT_EQ(name(PixelFormat::mjpeg), "mjpeg");
}

TEST(FrameFormat, Bounds) {
  EXPECT_TRUE(is_valid(packed_format(PixelFormat::rgb8, 1024, 768)));
  EXPECT_TRUE(is_valid(packed_format(PixelFormat::yuyv, 640, 480)));
  EXPECT_TRUE(is_valid(packed_format(PixelFormat::mjpeg, 640, 480)));
  EXPECT_TRUE(is_valid({PixelFormat::gray8, 100, 100, 128}));
  EXPECT_FALSE(is_valid({PixelFormat::gray8, 100, 100, 99}));
  EXPECT_FALSE(is_valid({PixelFormat::gray8, 100, 100, 101 + kMaxRowPadding}));
  EXPECT_FALSE(is_valid(packed_format(PixelFormat::uyvy, 641, 480)));
  EXPECT_TRUE(is_valid(packed_format(PixelFormat::nv12, 640, 480)));
  EXPECT_FALSE(is_valid(packed_format(PixelFormat::nv12, 641, 480)));
  EXPECT_FALSE(is_valid(packed_format(PixelFormat::nv12, 640, 481)));
  EXPECT_FALSE(is_valid(packed_format(PixelFormat::gray8, 0, 480)));
  EXPECT_FALSE(is_valid(packed_format(PixelFormat::gray8, -4, 480)));
  EXPECT_FALSE(is_valid(packed_format(PixelFormat::gray8, 640, kMaxFrameSide_px + 1)));
  EXPECT_FALSE(is_valid({PixelFormat::mjpeg, 640, 480, 640}));
}

TEST(FrameFormat, BytesOfAFrame) {
  EXPECT_EQ(packed_format(PixelFormat::rgb8, 1024, 768).bytes(), 1024U * 768 * 3);
  EXPECT_EQ(packed_format(PixelFormat::yuyv, 640, 480).bytes(), 640U * 480 * 2);
  EXPECT_EQ(packed_format(PixelFormat::bayer_grbg8, 640, 480).bytes(), 640U * 480);
  EXPECT_EQ(packed_format(PixelFormat::nv12, 640, 480).bytes(), 640U * 480 + 320 * 240 * 2);
  EXPECT_EQ((FrameFormat{PixelFormat::nv12, 640, 480, 700}).bytes(), 700U * 720);
}

}  // namespace
}  // namespace azimuth
