#include "tests/equipment/usb_camera/uvc_camera.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/usb/video.h>
#include <random>

#include "tests/equipment/usb_camera/usb_requests.hpp"
#include "tests/equipment/usb_camera/uvc_descriptors.hpp"
#include "tests/equipment/usb_camera/uvc_host.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth::sim::test {
namespace {

using testing::SizeIs;

constexpr std::size_t kTransfer = 16384;

struct UvcCameraTest : testing::Test {
  UvcCameraTest() { enumerate(camera); }
  Octets image(std::uint32_t number) const {
    Octets octets;
    fill_pattern(camera.shape(), number, octets);
    return octets;
  }
  ControlAnswer ask(std::uint8_t request, std::uint8_t selector, std::uint8_t entity, std::uint16_t length = kPlenty) {
    return camera.control(video_request(request, selector, entity, kControlInterface, length), {});
  }
  ControlAnswer set(std::uint8_t selector, std::uint8_t entity, const Octets& value) {
    return camera.control(
        video_request(UVC_SET_CUR, selector, entity, kControlInterface, static_cast<std::uint16_t>(value.size())),
        value);
  }
  int refusal() { return ask(UVC_GET_CUR, UVC_VC_REQUEST_ERROR_CODE_CONTROL, 0)->at(0); }

  UvcCamera camera{320, 240, 30.0, "SN42"};
};

/// The descriptors in a configuration; empty if they do not fill it exactly.
std::vector<Octets> split(OctetSpan configuration) {
  std::vector<Octets> parts;
  while (!configuration.empty()) {
    const std::size_t length = configuration[0];
    if (length < 2 || length > configuration.size()) return {};
    parts.emplace_back(configuration.begin(), configuration.begin() + static_cast<std::ptrdiff_t>(length));
    configuration = configuration.subspan(length);
  }
  return parts;
}

/// Total bytes of the class-specific descriptors that start at index `first`, up to the next descriptor of another
/// kind.
std::size_t class_bytes(const std::vector<Octets>& parts, std::size_t first) {
  std::size_t bytes = 0;
  for (std::size_t i = first; i < parts.size() && parts[i][1] == 0x24; ++i) bytes += parts[i].size();
  return bytes;
}

TEST_F(UvcCameraTest, ConfigurationIsFilledExactlyByItsDescriptors) {
  const Octets configuration = *camera.control(get_descriptor(2), {});
  EXPECT_EQ(get_le(OctetSpan(configuration).subspan(2), 2), configuration.size());
  const std::vector<Octets> parts = split(configuration);
  ASSERT_THAT(parts, SizeIs(testing::Gt(10U)));
  int interfaces = 0, endpoints = 0, headers = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    interfaces += parts[i][1] == 4 ? 1 : 0;
    endpoints += parts[i][1] == 5 ? 1 : 0;
    if (parts[i][1] != 0x24 || parts[i][2] != UVC_VC_HEADER || parts[i - 1][1] != 4) continue;
    ++headers;  // The total length lies one byte later in the control interface's header
    const std::size_t place = parts[i - 1][6] == UVC_SC_VIDEOCONTROL ? 5 : 4;
    EXPECT_EQ(get_le(OctetSpan(parts[i]).subspan(place), 2), class_bytes(parts, i));
  }
  EXPECT_EQ(interfaces, 2);
  EXPECT_EQ(endpoints, 1);
  EXPECT_EQ(headers, 2);
}

TEST_F(UvcCameraTest, DescribesEachFormatWithItsSize) {
  const std::vector<Octets> parts = split(*camera.control(get_descriptor(2), {}));
  std::vector<std::size_t> sizes;
  for (const Octets& part : parts) {
    if (part[1] == 0x24 && part[2] == UVC_VS_FRAME_UNCOMPRESSED && part.size() == 34) {
      EXPECT_EQ(get_le(OctetSpan(part).subspan(5), 2), 320U);
      EXPECT_EQ(get_le(OctetSpan(part).subspan(7), 2), 240U);
      EXPECT_EQ(get_le(OctetSpan(part).subspan(26), 4), 333333U);
      EXPECT_EQ(get_le(OctetSpan(part).subspan(30), 4), 666667U);
      sizes.push_back(get_le(OctetSpan(part).subspan(17), 4));
    }
  }
  EXPECT_THAT(sizes, testing::ElementsAre(320 * 240 * 2, 320 * 240 * 3 / 2, 320 * 240));
}

TEST_F(UvcCameraTest, TellsItsSerialNumber) {
  EXPECT_EQ(*camera.control(get_descriptor(3, 3), {}), (Octets{10, 3, 'S', 0, 'N', 0, '4', 0, '2', 0}));
  EXPECT_FALSE(camera.control(get_descriptor(3, 9), {}));
}

TEST_F(UvcCameraTest, AnswersAreCutToWhatIsAskedFor) {
  for (std::uint16_t length = 0; length < 300; ++length) {
    const Octets whole = *camera.control(get_descriptor(2), {});
    const Octets cut = *camera.control(get_descriptor(2, 0, length), {});
    EXPECT_EQ(cut.size(), std::min<std::size_t>(length, whole.size()));
    EXPECT_TRUE(std::equal(cut.begin(), cut.end(), whole.begin()));
  }
  for (const UvcControl& control : uvc_controls()) {
    for (const int number :
         {UVC_GET_CUR, UVC_GET_MIN, UVC_GET_MAX, UVC_GET_RES, UVC_GET_DEF, UVC_GET_LEN, UVC_GET_INFO}) {
      const auto request = static_cast<std::uint8_t>(number);
      const Octets whole = *ask(request, control.selector, control.entity);
      EXPECT_THAT(ask(request, control.selector, control.entity, 1), testing::Optional(Octets{whole[0]}));
      EXPECT_THAT(ask(request, control.selector, control.entity, 0), testing::Optional(Octets{}));
    }
  }
}

TEST_F(UvcCameraTest, AnyRequestIsAnsweredWithinItsLengthOrRefused) {
  std::mt19937 random(7);
  std::uint64_t refused = 0;
  for (int i = 0; i < 200'000; ++i) {
    ControlRequest request{.type = static_cast<std::uint8_t>(random()),
                           .request = static_cast<std::uint8_t>(random()),
                           .value = static_cast<std::uint16_t>(random()),
                           .index = static_cast<std::uint16_t>(random() & 0x703U),
                           .length = static_cast<std::uint16_t>(random() % 64)};
    if (random() % 2 == 0) request.type = random() % 2 == 0 ? 0xa1 : 0x21;
    if (random() % 2 == 0) request.value = static_cast<std::uint16_t>(request.value & 0xf00U);
    const Octets data(request.to_host() ? 0 : request.length, static_cast<std::uint8_t>(random()));
    const ControlAnswer answer = camera.control(request, data);
    ASSERT_TRUE(!answer || answer->size() <= request.length);
    refused += answer ? 0 : 1;
  }
  EXPECT_GT(refused, 100'000U);
}

TEST_F(UvcCameraTest, SettingsAreKeptAndReadBack) {
  EXPECT_TRUE(set(UVC_PU_GAIN_CONTROL, kProcessingUnit, {200, 0}));
  EXPECT_THAT(ask(UVC_GET_CUR, UVC_PU_GAIN_CONTROL, kProcessingUnit), testing::Optional(Octets{200, 0}));
  EXPECT_TRUE(set(UVC_PU_BRIGHTNESS_CONTROL, kProcessingUnit, {0xe0, 0xff}));
  EXPECT_EQ(camera.controls().value(kProcessingUnit, UVC_PU_BRIGHTNESS_CONTROL), -32);
  EXPECT_FALSE(set(UVC_PU_BRIGHTNESS_CONTROL, kProcessingUnit, {0x80, 0xff}));
  EXPECT_EQ(refusal(), static_cast<int>(UvcRefusal::out_of_range));
  EXPECT_FALSE(set(UVC_PU_GAIN_CONTROL, kProcessingUnit, {1}));
  EXPECT_EQ(refusal(), static_cast<int>(UvcRefusal::invalid_request));
  EXPECT_FALSE(ask(UVC_GET_CUR, UVC_PU_HUE_CONTROL, kProcessingUnit));
  EXPECT_EQ(refusal(), static_cast<int>(UvcRefusal::invalid_control));
}

TEST_F(UvcCameraTest, ExposureCanBeSetOnlyWhileItIsManual) {
  const Octets ten_ms{100, 0, 0, 0};
  const auto info = [&] { return ask(UVC_GET_INFO, UVC_CT_EXPOSURE_TIME_ABSOLUTE_CONTROL, kCameraTerminal)->at(0); };
  EXPECT_EQ(info() & UVC_CONTROL_CAP_DISABLED, UVC_CONTROL_CAP_DISABLED);
  EXPECT_FALSE(set(UVC_CT_EXPOSURE_TIME_ABSOLUTE_CONTROL, kCameraTerminal, ten_ms));
  EXPECT_EQ(refusal(), static_cast<int>(UvcRefusal::wrong_state));
  EXPECT_FALSE(set(UVC_CT_AE_MODE_CONTROL, kCameraTerminal, {2}));
  EXPECT_FALSE(set(UVC_CT_AE_MODE_CONTROL, kCameraTerminal, {9}));
  EXPECT_TRUE(set(UVC_CT_AE_MODE_CONTROL, kCameraTerminal, {1}));
  EXPECT_EQ(info() & UVC_CONTROL_CAP_DISABLED, 0);
  EXPECT_TRUE(set(UVC_CT_EXPOSURE_TIME_ABSOLUTE_CONTROL, kCameraTerminal, ten_ms));
  EXPECT_EQ(camera.controls().value(kCameraTerminal, UVC_CT_EXPOSURE_TIME_ABSOLUTE_CONTROL), 100);
}

TEST_F(UvcCameraTest, AgreesOnWhatItHas) {
  start_uvc(camera, 2, 500'000);
  EXPECT_EQ(camera.shape(), (WireShape{WireFormat::nv12, 320, 240}));
  EXPECT_NEAR(camera.rate_hz(), 15.0, 1e-3);
  start_uvc(camera, 77, 0xffffffff);
  EXPECT_EQ(camera.shape().format, WireFormat::yuyv);
  EXPECT_NEAR(camera.rate_hz(), 15.0, 1e-3);
  start_uvc(camera, 3, 0);
  EXPECT_EQ(camera.shape().format, WireFormat::grey);
  EXPECT_NEAR(camera.rate_hz(), 30.0, 1e-3);
  const Octets agreement = *camera.control(video_request(UVC_GET_CUR, UVC_VS_PROBE_CONTROL, 0, 1, 26), {});
  EXPECT_EQ(get_le(OctetSpan(agreement).subspan(18), 4), 320U * 240U);
  EXPECT_EQ(get_le(OctetSpan(agreement).subspan(22), 4), UvcCamera::kMaxPayloadBytes);
}

/// Transfers of any size that a host may choose carry the same images.
class UvcTransfers : public UvcCameraTest, public testing::WithParamInterface<std::size_t> {};

TEST_P(UvcTransfers, CarryWholeImages) {
  start_uvc(camera);
  UvcHost host(GetParam(), UvcCamera::kMaxPayloadBytes);
  for (std::uint32_t number = 0; number < 5; ++number) {
    ASSERT_TRUE(camera.ready());
    camera.begin_image(image(number), ImageFlaw::none);
    ASSERT_TRUE(host.read_all(camera));
    EXPECT_TRUE(host.between_payloads());
  }
  ASSERT_THAT(host.images(), SizeIs(5));
  for (std::uint32_t number = 0; number < 5; ++number) {
    const ReceivedImage& received = host.images()[number];
    EXPECT_EQ(check_pattern(camera.shape(), received.bytes), number);
    EXPECT_TRUE(received.ended);
    EXPECT_FALSE(received.error);
  }
}
INSTANTIATE_TEST_SUITE_P(Rooms, UvcTransfers, testing::Values(512U, 1024U, 8192U, kTransfer, 3 * kTransfer),
                         azimuth::test::PrintedName());

TEST_F(UvcCameraTest, AnImageThatFillsItsLastTransferEnds) {
  UvcCamera small(16, 16, 30.0, "S");  // an image has 512 bytes, 514 with its header
  start_uvc(small);
  Octets octets;
  fill_pattern(small.shape(), 3, octets);
  for (const std::size_t room : {std::size_t{257}, std::size_t{514}}) {
    UvcHost host(room, UvcCamera::kMaxPayloadBytes);
    small.begin_image(octets, ImageFlaw::none);
    ASSERT_TRUE(host.read_all(small));
    EXPECT_TRUE(host.between_payloads());
    ASSERT_THAT(host.images(), SizeIs(1));
    EXPECT_TRUE(host.images()[0].ended);
    EXPECT_EQ(host.images()[0].bytes, octets);
  }
}

TEST_F(UvcCameraTest, FlawsShowAndPass) {
  start_uvc(camera);
  UvcHost host(kTransfer, UvcCamera::kMaxPayloadBytes);
  for (const ImageFlaw flaw : {ImageFlaw::none, ImageFlaw::marked_bad, ImageFlaw::cut_short, ImageFlaw::none}) {
    camera.begin_image(image(1), flaw);
    ASSERT_TRUE(host.read_all(camera));
  }
  const std::vector<ReceivedImage>& images = host.images();
  ASSERT_THAT(images, SizeIs(4));
  EXPECT_FALSE(images[0].error);
  EXPECT_TRUE(images[1].error);
  EXPECT_EQ(images[1].bytes.size(), camera.shape().bytes());
  EXPECT_EQ(images[2].bytes.size(), camera.shape().bytes() / 2);
  EXPECT_TRUE(images[2].ended);
  EXPECT_EQ(check_pattern(camera.shape(), images[3].bytes), 1U);
}

TEST_F(UvcCameraTest, HangsUntilItIsReset) {
  start_uvc(camera);
  camera.begin_image(image(1), ImageFlaw::none);
  camera.hang();
  EXPECT_FALSE(camera.next_transfer(kTransfer));
  EXPECT_FALSE(camera.ready());
  camera.control(set_configuration(), {});  // a program configures it again, without a port reset
  start_uvc(camera);
  EXPECT_FALSE(camera.ready());
  const std::uint64_t resets = camera.resets();
  enumerate(camera);
  EXPECT_EQ(camera.resets(), resets + 1);
  EXPECT_FALSE(camera.ready());
  start_uvc(camera);
  EXPECT_TRUE(camera.ready());
}

TEST_F(UvcCameraTest, FrozenItStaysSoThroughAReset) {
  start_uvc(camera);
  camera.freeze(true);
  enumerate(camera);
  start_uvc(camera);
  EXPECT_FALSE(camera.ready());
  camera.freeze(false);
  EXPECT_TRUE(camera.ready());
}

TEST_F(UvcCameraTest, ClearingTheEndpointEndsTheStream) {
  start_uvc(camera);
  camera.begin_image(image(1), ImageFlaw::none);
  EXPECT_TRUE(camera.control({.type = 2, .request = 1, .value = 0, .index = kImageEndpoint}, {}));
  EXPECT_FALSE(camera.streaming());
  EXPECT_FALSE(camera.next_transfer(kTransfer));
}

TEST_F(UvcCameraTest, PowerUpForgetsSettings) {
  set(UVC_PU_GAIN_CONTROL, kProcessingUnit, {200, 0});
  start_uvc(camera, 3);
  camera.power_up();
  EXPECT_EQ(camera.controls().value(kProcessingUnit, UVC_PU_GAIN_CONTROL), 64);
  EXPECT_EQ(camera.shape().format, WireFormat::yuyv);
  EXPECT_FALSE(camera.streaming());
}

}  // namespace
}  // namespace azimuth::sim::test
