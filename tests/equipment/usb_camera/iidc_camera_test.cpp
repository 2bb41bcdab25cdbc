#include "tests/equipment/usb_camera/iidc_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "tests/equipment/usb_camera/usb_requests.hpp"

namespace azimuth::sim::test {
namespace {

constexpr std::uint32_t kBase = 0xf0f00000, kRom = 0xf0000400;
constexpr std::uint64_t kGuid = 0x00b09d0100c0ffee;

struct IidcCameraTest : testing::Test {
  IidcCameraTest() { enumerate(camera); }
  std::optional<std::uint32_t> read(std::uint32_t address) {
    const ControlAnswer answer = camera.control(register_request(true, address, 4), {});
    return answer ? std::optional(static_cast<std::uint32_t>(get_le(*answer, 4))) : std::nullopt;
  }
  bool write(std::uint32_t offset, std::uint32_t value) {
    Octets data;
    put_le(data, value);
    return camera.control(register_request(false, kBase + offset, 4), data).has_value();
  }
  void start() { ASSERT_TRUE(write(iidc::kStreaming, 0x80000000)); }

  IidcCamera camera{kGuid, "SN7"};
};

TEST_F(IidcCameraTest, RomLeadsToTheRegisters) {
  EXPECT_EQ(read(kRom + 4), 0x31333934U);  // "1394"
  EXPECT_EQ(read(kRom + 12), kGuid >> 32U);
  EXPECT_EQ(read(kRom + 16), kGuid & 0xffffffff);
  // Follows the directories as libdc1394 does: root, unit, unit-dependent.
  const auto follow = [&](std::uint32_t directory, std::uint32_t key) {
    const std::uint32_t entries = *read(directory) >> 16U;
    for (std::uint32_t i = 1; i <= entries; ++i) {
      const std::uint32_t entry = *read(directory + 4 * i);
      if (entry >> 24U == key) return directory + 4 * i + 4 * (entry & 0xffffff);
    }
    return 0U;
  };
  const std::uint32_t dependent = follow(follow(kRom + 20, 0xd1), 0xd4);
  EXPECT_EQ(*read(dependent + 4), 0x40000000U | (kBase - 0xf0000000) / 4);
  EXPECT_EQ(*read(follow(dependent, 0x81) + 12), 0x417a696dU);  // "Azim"
  EXPECT_EQ(*read(follow(dependent, 0x82) + 12), 0x5643414dU);  // "VCAM"
}

TEST_F(IidcCameraTest, ModeAndRateMakeTheImages) {
  EXPECT_EQ(camera.shape(), (WireShape{WireFormat::grey, 640, 480}));
  EXPECT_EQ(camera.rate_hz(), 15.0);
  EXPECT_TRUE(write(iidc::kMode, 1U << 29U));
  EXPECT_TRUE(write(iidc::kRate, 2U << 29U));
  EXPECT_EQ(camera.shape(), (WireShape{WireFormat::uyvy, 320, 240}));
  EXPECT_EQ(camera.rate_hz(), 7.5);
  EXPECT_FALSE(write(iidc::kMode, 2U << 29U));
  EXPECT_FALSE(write(iidc::kRate, 6U << 29U));
  EXPECT_EQ(camera.shape().width_px, 320);
}

TEST_F(IidcCameraTest, FeaturesKeepWhatTheyCanHave) {
  EXPECT_NE(*read(kBase + 0x404) & 0x80000000U >> ((iidc::kGain - 0x800) / 4), 0U);
  EXPECT_TRUE(write(iidc::kGain, 0x82000000U | 77));
  EXPECT_EQ(read(kBase + iidc::kGain), 0x82000000U | 77);
  EXPECT_TRUE(write(iidc::kGain, 0x82000000U | 0xfff));
  EXPECT_EQ(*read(kBase + iidc::kGain) & 0xfffU, 1023U);
  EXPECT_TRUE(write(iidc::kWhiteBalance, 0x82000000U | 300U << 12U | 400U));
  EXPECT_EQ(read(kBase + iidc::kWhiteBalance), 0x82000000U | 300U << 12U | 400U);
  EXPECT_TRUE(write(0x814, 5));  // there is no such feature
  EXPECT_EQ(read(kBase + 0x814), 0U);
}

TEST_F(IidcCameraTest, ReadsSeveralRegistersAtOnce) {
  const ControlAnswer answer = camera.control(register_request(true, kRom, 20), {});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->size(), 20U);
  EXPECT_FALSE(camera.control(register_request(true, 0x1000, 4), {}));
  EXPECT_FALSE(camera.control(register_request(true, kBase + 2, 4), {}));
  EXPECT_FALSE(camera.control(register_request(true, kBase + 0xffc, 8), {}));
}

TEST_F(IidcCameraTest, AnyRequestIsAnsweredWithinItsLengthOrRefused) {
  std::mt19937 random(11);
  for (int i = 0; i < 100'000; ++i) {
    ControlRequest request{.type = static_cast<std::uint8_t>(random()),
                           .request = static_cast<std::uint8_t>(random() % 2 == 0 ? 0x7f : random()),
                           .value = static_cast<std::uint16_t>(random()),
                           .index = static_cast<std::uint16_t>(random() % 2 == 0 ? 0xf0f0 : random()),
                           .length = static_cast<std::uint16_t>(random() % 64)};
    if (random() % 2 == 0) request.type = random() % 2 == 0 ? 0xc0 : 0x40;
    const Octets data(request.to_host() ? 0 : request.length, static_cast<std::uint8_t>(random()));
    const ControlAnswer answer = camera.control(request, data);
    ASSERT_TRUE(!answer || answer->size() <= request.length);
  }
  EXPECT_GT(camera.shape().bytes(), 0U);
}

TEST_F(IidcCameraTest, ImagesFollowEachOther) {
  start();
  for (std::uint32_t number = 0; number < 3; ++number) {
    Octets image, received;
    fill_pattern(camera.shape(), number, image);
    ASSERT_TRUE(camera.ready());
    camera.begin_image(image, ImageFlaw::none);
    while (const auto transfer = camera.next_transfer(100'000)) put_octets(received, transfer->bytes);
    EXPECT_EQ(check_pattern(camera.shape(), received), number);
  }
}

TEST_F(IidcCameraTest, FlawsEndTheImage) {
  start();
  const Octets image(camera.shape().bytes(), 9);
  camera.begin_image(image, ImageFlaw::cut_short);
  EXPECT_EQ(camera.next_transfer(image.size())->bytes.size(), image.size() / 2);
  EXPECT_TRUE(camera.ready());
  camera.begin_image(image, ImageFlaw::marked_bad);
  const std::optional<BulkAnswer> failed = camera.next_transfer(image.size());
  EXPECT_TRUE(failed->failed);
  EXPECT_TRUE(failed->bytes.empty());
  ASSERT_TRUE(camera.ready());
  camera.begin_image(image, ImageFlaw::none);
  EXPECT_FALSE(camera.next_transfer(image.size())->failed);
}

TEST_F(IidcCameraTest, AConfiguredDeviceStreamsOnlyWhenToldAnew) {
  start();
  EXPECT_TRUE(camera.streaming());
  camera.control(set_configuration(), {});
  EXPECT_FALSE(camera.streaming());
  EXPECT_TRUE(write(iidc::kGain, 0x82000000U));
  EXPECT_FALSE(camera.streaming());
  start();
  EXPECT_TRUE(camera.streaming());
  EXPECT_TRUE(write(iidc::kStreaming, 0));
  EXPECT_FALSE(camera.streaming());
}

}  // namespace
}  // namespace azimuth::sim::test
