#include "tests/equipment/usb_camera/usbip_link.hpp"

#include <array>
#include <cerrno>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include "tests/equipment/usb_camera/usb_requests.hpp"
#include "tests/equipment/usb_camera/uvc_camera.hpp"

namespace azimuth::sim::test {
namespace {

struct UsbipReply {
  std::uint32_t command = 0, sequence = 0;
  int status = 0;
  std::uint32_t bytes = 0;
  Octets data;
};

std::uint32_t word(OctetSpan header, std::size_t place) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8U | header[place + i];
  return number;
}

/// The test takes the kernel's end of the cable.
struct UsbipLinkTest : testing::Test {
  UsbipLinkTest() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    link = std::make_unique<UsbipLink>(UniqueFd(ends[0]), camera);
    host = UniqueFd(ends[1]);
  }
  void send(const Octets& bytes) const {
    ASSERT_EQ(::send(host.get(), bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  }
  static Octets header(std::uint32_t command, std::uint32_t sequence, bool to_host, std::uint32_t endpoint) {
    Octets packet;
    for (const std::uint32_t number : {command, sequence, 0x10001U, to_host ? 1U : 0U, endpoint}) {
      for (unsigned shift = 32; shift > 0; shift -= 8)
        packet.push_back(static_cast<std::uint8_t>(number >> (shift - 8)));
    }
    packet.resize(kUsbipHeaderBytes);
    return packet;
  }
  static void put_big(Octets& packet, std::size_t place, std::uint32_t number) {
    for (std::size_t i = 0; i < 4; ++i) packet[place + i] = static_cast<std::uint8_t>(number >> (24 - 8 * i));
  }
  void submit(std::uint32_t sequence, bool to_host, std::uint32_t endpoint, std::uint32_t bytes,
              const ControlRequest& request = {}, const Octets& data = {}) const {
    Octets packet = header(1, sequence, to_host, endpoint);
    put_big(packet, 24, bytes);
    Octets setup{request.type, request.request};
    put_le(setup, request.value);
    put_le(setup, request.index);
    put_le(setup, request.length);
    std::copy(setup.begin(), setup.end(), packet.begin() + 40);
    put_octets(packet, data);
    send(packet);
  }
  void unlink(std::uint32_t sequence, std::uint32_t victim) const {
    Octets packet = header(2, sequence, false, 0);
    put_big(packet, 20, victim);
    send(packet);
  }
  std::optional<UsbipReply> reply() const {
    UsbipHeader bytes{};
    if (::recv(host.get(), bytes.data(), bytes.size(), MSG_DONTWAIT) != kUsbipHeaderBytes) return std::nullopt;
    UsbipReply reply{word(bytes, 0), word(bytes, 4), static_cast<int>(word(bytes, 20)), word(bytes, 24), {}};
    if (reply.command != 3 || reply.bytes == 0) return reply;
    reply.data.resize(reply.bytes);
    const ssize_t count = ::recv(host.get(), reply.data.data(), reply.data.size(), MSG_DONTWAIT);
    reply.data.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    return reply;
  }
  void start_image(std::uint32_t number) {
    start_uvc(camera);
    Octets image;
    fill_pattern(camera.shape(), number, image);
    camera.begin_image(image, ImageFlaw::none);
  }

  UvcCamera camera{32, 16, 30.0, "SN1"};  // an image has 1024 bytes
  std::unique_ptr<UsbipLink> link;
  UniqueFd host;
};

TEST_F(UsbipLinkTest, AnswersControlRequests) {
  submit(5, true, 0, 18, get_descriptor(1, 0, 18));
  ASSERT_TRUE(link->serve());
  const auto answer = reply();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->command, 3U);
  EXPECT_EQ(answer->sequence, 5U);
  EXPECT_EQ(answer->status, 0);
  EXPECT_EQ(answer->data.size(), 18U);
  EXPECT_EQ(answer->data[0], 18);
}

TEST_F(UsbipLinkTest, RefusalsAreStalls) {
  submit(6, true, 0, 4, get_descriptor(42, 0, 4));
  ASSERT_TRUE(link->serve());
  EXPECT_EQ(reply()->status, -EPIPE);
  submit(7, false, 2, 3, {}, {1, 2, 3});  // there is no endpoint for output
  ASSERT_TRUE(link->serve());
  const auto refused = reply();
  EXPECT_EQ(refused->sequence, 7U);
  EXPECT_EQ(refused->status, -EPIPE);
}

TEST_F(UsbipLinkTest, TransfersWaitForAnImage) {
  submit(8, true, 1, 16384);
  ASSERT_TRUE(link->serve());
  EXPECT_EQ(link->waiting(), 1U);
  EXPECT_FALSE(reply());
  start_image(77);
  ASSERT_TRUE(link->pump());
  const auto answer = reply();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->sequence, 8U);
  ASSERT_EQ(answer->data.size(), 1026U);
  EXPECT_EQ(check_pattern(camera.shape(), OctetSpan(answer->data).subspan(2)), 77U);
  EXPECT_EQ(link->waiting(), 0U);
}

TEST_F(UsbipLinkTest, AnUnlinkedTransferIsAnsweredOnce) {
  for (const std::uint32_t sequence : {10U, 11U, 12U}) {
    submit(sequence, true, 1, 16384);
    ASSERT_TRUE(link->serve());
  }
  unlink(13, 11);
  ASSERT_TRUE(link->serve());
  const auto given_up = reply();
  ASSERT_TRUE(given_up);
  EXPECT_EQ(given_up->command, 4U);
  EXPECT_EQ(given_up->sequence, 13U);
  EXPECT_EQ(given_up->status, -ECONNRESET);
  start_image(1);
  ASSERT_TRUE(link->pump());
  EXPECT_EQ(reply()->sequence, 10U);
  EXPECT_FALSE(reply());
  unlink(14, 10);  // the transfer has already ended
  ASSERT_TRUE(link->serve());
  const auto late = reply();
  EXPECT_EQ(late->command, 4U);
  EXPECT_EQ(late->status, 0);
  EXPECT_EQ(link->waiting(), 1U);
}

TEST_F(UsbipLinkTest, EndsWithTheCable) {
  host = UniqueFd();
  EXPECT_FALSE(link->serve());
}

TEST_F(UsbipLinkTest, NoticesTheEndWhileSending) {
  submit(15, true, 1, 16384);
  ASSERT_TRUE(link->serve());
  host = UniqueFd();
  start_image(1);
  EXPECT_FALSE(link->pump());
}

TEST_F(UsbipLinkTest, EndsWithNonsense) {
  send(header(9, 1, false, 0));
  EXPECT_FALSE(link->serve());
}

TEST_F(UsbipLinkTest, EndsWithinAPacket) {
  send(Octets(20, 0));
  host = UniqueFd();
  EXPECT_FALSE(link->serve());
}

TEST_F(UsbipLinkTest, RefusesToBeFlooded) {
  submit(16, false, 0, 0x7fffffff, {.type = 0x21, .request = 1});
  EXPECT_FALSE(link->serve());
}

}  // namespace
}  // namespace azimuth::sim::test
