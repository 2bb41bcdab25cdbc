#include "drivers/usb/usb_port.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

std::string text_of(const std::optional<UsbPort>& port) { return port ? port->text() : "none"; }

TEST(UsbPort, SaysWhatSysfsSays) {
  const std::array<std::uint8_t, 2> ports{2, 3};
  EXPECT_EQ(text_of(UsbPort::make(1, ports)), "1-2.3");
  EXPECT_EQ(text_of(UsbPort::parse("1-2.3")), "1-2.3");
  EXPECT_EQ(UsbPort::parse("1-2.3"), UsbPort::make(1, ports));
  EXPECT_EQ(text_of(UsbPort::parse("255-255.1.2.3.4.5.255")), "255-255.1.2.3.4.5.255");
}

TEST(UsbPort, RefusesWhatIsNoPort) {
  for (const char* text : {"",      "1",    "1-",        "-1",    "usb1", "0-1",    "1-0",
                           "1-01",  "01-1", "256-1",     "1-256", "1-2.", "1-.2",   "1-2..3",
                           "1-2-3", "1.2",  "1-2.3:1.0", " 1-2",  "1-2 ", "1-0050", "1-1.1.1.1.1.1.1.1",
                           "1-a",   "+1-2", "1-+2"})
    EXPECT_FALSE(UsbPort::parse(text)) << text;
  EXPECT_FALSE(UsbPort::make(1, {})) << "a root hub";
  const std::array<std::uint8_t, 8> too_deep{1, 1, 1, 1, 1, 1, 1, 1};
  EXPECT_FALSE(UsbPort::make(1, too_deep));
  EXPECT_FALSE(UsbPort::make(0, std::span(too_deep).first(1)));
}

RC_GTEST_PROP(UsbPort, ComesBackFromItsText, ()) {
  const auto bus = *rc::gen::inRange<int>(1, 256);
  const auto depth = *rc::gen::inRange<std::size_t>(1, UsbPort::kMaxDepth + 1);
  const auto numbers = *rc::gen::container<std::vector<int>>(depth, rc::gen::inRange(1, 256));
  std::vector<std::uint8_t> ports(numbers.begin(), numbers.end());
  const auto port = UsbPort::make(static_cast<std::uint8_t>(bus), ports);
  RC_ASSERT(port.has_value());
  RC_ASSERT(UsbPort::parse(port->text()) == port);
}

RC_GTEST_PROP(UsbPort, WhatIsParsedSaysTheSameText, ()) {
  const auto text = *rc::gen::container<std::string>(rc::gen::elementOf(std::string("0123459-.:")));
  const auto port = UsbPort::parse(text);
  if (port) RC_ASSERT(port->text() == text);
}

TEST(UsbPort, IsTheInnermostDeviceOfAPath) {
  const std::string pci = "/sys/devices/pci0000:00/0000:00:14.0/";
  EXPECT_EQ(text_of(usb_port_in_path(pci + "usb1/1-2/1-2.3/1-2.3:1.0/ttyUSB0/tty/ttyUSB0")), "1-2.3");
  EXPECT_EQ(text_of(usb_port_in_path(pci + "usb2/2-1/2-1:1.0/video4linux/video0")), "2-1");
  EXPECT_EQ(text_of(usb_port_in_path("/sys/devices/platform/vhci_hcd.0/usb3/3-1/3-1:1.0/video4linux/video2")), "3-1");
  EXPECT_EQ(text_of(usb_port_in_path(pci + "usb1/1-0:1.0")), "none") << "the root hub itself";
  EXPECT_EQ(text_of(usb_port_in_path("/sys/devices/pnp0/00:01/tty/ttyS0")), "none");
  EXPECT_EQ(text_of(usb_port_in_path("/sys/devices/pci0000:00/i2c-1/1-50/1-50.1")), "none") << "another kind of bus";
  EXPECT_EQ(text_of(usb_port_in_path(pci + "usb1/1-2/1-2:1.0/i2c-4/4-5")), "1-2") << "an I2C bus in a USB device";
}

/// /dev/null stands for a device; the test's own sysfs tells where it is connected.
class NodeTest : public ::testing::Test {
 protected:
  void lead_to(const std::string& device) const {
    struct stat null {};
    ASSERT_EQ(::stat("/dev/null", &null), 0);
    std::filesystem::create_directories(folder_.path() / "dev" / "char");
    std::filesystem::create_directories(folder_.path() / device);
    std::filesystem::create_directory_symlink(
        folder_.path() / device, folder_.path() / "dev" / "char" /
                                     (std::to_string(major(null.st_rdev)) + ":" + std::to_string(minor(null.st_rdev))));
  }
  test::TemporaryFolder folder_;
};

TEST_F(NodeTest, IsFoundThroughItsNumbersWhateverItsName) {
  lead_to("devices/pci0/usb1/1-4/1-4:1.0/ttyUSB0/tty/ttyUSB0");
  EXPECT_EQ(text_of(usb_port_of_node("/dev/null", folder_.path())), "1-4");
  const auto name = folder_.path() / "pioneer";
  std::filesystem::create_symlink("/dev/null", name);
  EXPECT_EQ(text_of(usb_port_of_node(name, folder_.path())), "1-4");
}

TEST_F(NodeTest, HasNoPortWhenItIsNotThereOrNotByUsb) {
  EXPECT_EQ(text_of(usb_port_of_node("/dev/null", folder_.path())), "none") << "not in sysfs";
  lead_to("devices/platform/serial/tty/ttyS0");
  EXPECT_EQ(text_of(usb_port_of_node("/dev/null", folder_.path())), "none");
  EXPECT_EQ(text_of(usb_port_of_node(folder_.path() / "gone")), "none");
  EXPECT_EQ(text_of(usb_port_of_node(folder_.path())), "none") << "no device";
  EXPECT_EQ(text_of(usb_port_of_node("tcp:localhost:8101")), "none");
}

}  // namespace
}  // namespace azimuth
