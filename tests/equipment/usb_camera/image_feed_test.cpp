#include "tests/equipment/usb_camera/image_feed.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <poll.h>
#include <system_error>

#include "drivers/camera/camera_server.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth::sim::test {
namespace {

using azimuth::test::TemporaryFolder;
using std::chrono::seconds;

constexpr int kPatience_ms = 10'000;

TEST(FileFeed, RepeatsWholeImages) {
  const TemporaryFolder folder;
  std::ofstream(folder / "images") << "abcdefghijkl"
                                   << "rest";
  FileFeed feed(folder / "images");
  const WireShape shape{WireFormat::grey, 3, 2};
  Octets image;
  for (const std::string expected : {"abcdef", "ghijkl", "abcdef", "ghijkl"}) {
    ASSERT_TRUE(feed.fill(shape, 0, image));
    EXPECT_EQ(std::string(image.begin(), image.end()), expected);
  }
}

TEST(FileFeed, HasNothingFromAFileThatIsTooShort) {
  const TemporaryFolder folder;
  std::ofstream(folder / "images") << "abc";
  FileFeed feed(folder / "images");
  Octets image;
  EXPECT_FALSE(feed.fill({WireFormat::grey, 3, 2}, 0, image));
  EXPECT_THROW(FileFeed(folder / "others"), std::system_error);
}

struct LinkFeedTest : testing::Test {
  static CameraServer serve(const std::filesystem::path& path) {
    FileResult<CameraServer> server = CameraServer::listen(path, {packed_format(PixelFormat::rgb8, 4, 2), 4, 0});
    if (!server) throw std::runtime_error(server.error().front().text());
    return *std::move(server);
  }
  static Stamp now() { return Stamp{std::chrono::duration_cast<Duration>(ImageFeed::Clock::now().time_since_epoch())}; }
  /// Sends an image of one brightness.
  void send(int brightness) {
    server.turn();
    const std::span<std::byte> pixels = server.next_frame();
    if (pixels.empty()) return;
    std::ranges::fill(pixels, static_cast<std::byte>(brightness));
    server.send_frame(now() - age);
  }
  /// Sends images until one arrives at the feed.
  bool arrives(int brightness) {
    const auto end = ImageFeed::Clock::now() + std::chrono::milliseconds(kPatience_ms);
    while (ImageFeed::Clock::now() < end) {
      send(brightness);
      pollfd watched{feed.descriptor(), POLLIN, 0};
      ::poll(&watched, 1, 10);
      if (feed.turn(ImageFeed::Clock::now())) return true;
    }
    return false;
  }

  TemporaryFolder folder;
  CameraServer server = serve(folder / "camera");
  LinkFeed feed{folder / "camera"};
  Duration age{};  // age of the images when they are sent
};

TEST_F(LinkFeedTest, GivesWhatHasArrived) {
  Octets image;
  EXPECT_FALSE(feed.fill({WireFormat::yuyv, 4, 2}, 0, image));
  ASSERT_TRUE(arrives(255));
  ASSERT_TRUE(feed.fill({WireFormat::yuyv, 4, 2}, 0, image));
  EXPECT_EQ(image, (Octets{235, 128, 235, 128, 235, 128, 235, 128, 235, 128, 235, 128, 235, 128, 235, 128}));
  ASSERT_TRUE(feed.fill({WireFormat::mjpeg, 4, 2}, 12, image));
  EXPECT_EQ(jpeg_tag(image), 12U);
}

TEST_F(LinkFeedTest, HasNothingOfAnotherSize) {
  ASSERT_TRUE(arrives(9));
  Octets image;
  EXPECT_FALSE(feed.fill({WireFormat::yuyv, 8, 2}, 0, image));
}

TEST_F(LinkFeedTest, LosesWhatComesTooLate) {
  ASSERT_TRUE(arrives(255));
  age = std::chrono::seconds(1);
  for (int i = 0; i < 5; ++i) {
    send(9);
    pollfd watched{feed.descriptor(), POLLIN, 0};
    ::poll(&watched, 1, 100);
    EXPECT_FALSE(feed.turn(ImageFeed::Clock::now()));
  }
  EXPECT_TRUE(feed.status().find("stale=0") == std::string::npos) << feed.status();
  Octets image;
  ASSERT_TRUE(feed.fill({WireFormat::grey, 4, 2}, 0, image));
  EXPECT_EQ(image[0], 255);
}

TEST_F(LinkFeedTest, SurvivesItsServer) {
  ASSERT_TRUE(arrives(1));
  { const CameraServer gone = std::move(server); }
  feed.turn(ImageFeed::Clock::now());
  CameraServer next = serve(folder / "camera");
  Octets image;
  const auto end = ImageFeed::Clock::now() + std::chrono::milliseconds(kPatience_ms);
  bool again = false;
  while (!again && ImageFeed::Clock::now() < end) {
    next.turn();
    if (const std::span<std::byte> pixels = next.next_frame(); !pixels.empty()) {
      std::ranges::fill(pixels, std::byte{0});
      next.send_frame(now());
    }
    again = feed.turn(ImageFeed::Clock::now()) && feed.fill({WireFormat::grey, 4, 2}, 0, image) && image[0] == 0;
  }
  EXPECT_TRUE(again);
}

}  // namespace
}  // namespace azimuth::sim::test
