#include "drivers/usb/port_reset.hpp"

#include <gmock/gmock.h>

#include "tests/drivers/usb/fake_libusb.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::fake_usb;
using test::UsbCall;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class PortResetTest : public ::testing::Test {
 protected:
  PortResetTest() {
    test::reset_fake_usb();
    fake_usb().devices = {{1, {}}, {1, {2}}, {1, {2, 3}}, {2, {2, 3}}};
  }
  void TearDown() override {
    EXPECT_EQ(fake_usb().contexts, 0);
    EXPECT_EQ(fake_usb().handles, 0);
    EXPECT_EQ(fake_usb().lists, 0);
  }
  PortResetResult reset(const char* port) { return resetter_.reset(*UsbPort::parse(port), now_); }

  PortReset resetter_;
  PortReset::Clock::time_point now_{1h};
};

TEST_F(PortResetTest, ResetsTheDeviceAtThatPortAndNoOther) {
  const PortResetResult result = reset("1-2.3");
  EXPECT_TRUE(result.done);
  EXPECT_THAT(result.text, AllOf(HasSubstr("1-2.3"), HasSubstr("reset")));
  EXPECT_THAT(fake_usb().resets, ElementsAre(ElementsAre(2, 3)));
}

TEST_F(PortResetTest, ADeviceThatComesBackAsANewOneHasBeenReset) {
  fake_usb().fail(UsbCall::reset, LIBUSB_ERROR_NOT_FOUND);
  const PortResetResult result = reset("1-2.3");
  EXPECT_TRUE(result.done);
  EXPECT_THAT(result.text, HasSubstr("came back"));
}

TEST_F(PortResetTest, EveryCallThatFailsIsNamed) {
  for (const auto& [call, words] : {std::pair{UsbCall::init, "cannot start libusb"},
                                    {UsbCall::list, "cannot list the devices"},
                                    {UsbCall::open, "cannot open"},
                                    {UsbCall::reset, "cannot reset"}}) {
    fake_usb().fail(call, LIBUSB_ERROR_OTHER);
    const PortResetResult result = reset("1-2.3");
    EXPECT_FALSE(result.done);
    EXPECT_THAT(result.text, AllOf(HasSubstr("USB port 1-2.3: "), HasSubstr(words), HasSubstr("Other error")));
    now_ += 1min;
  }
  EXPECT_THAT(fake_usb().resets, IsEmpty());
}

TEST_F(PortResetTest, SaysWhatToDoAboutMissingPermission) {
  fake_usb().fail(UsbCall::open, LIBUSB_ERROR_ACCESS);
  EXPECT_THAT(reset("1-2.3").text, AllOf(HasSubstr("Access denied"), HasSubstr("udev rule")));
}

TEST_F(PortResetTest, SaysWhenNothingIsThere) {
  const PortResetResult result = reset("1-7");
  EXPECT_FALSE(result.done);
  EXPECT_THAT(result.text, HasSubstr("nothing to reset"));
}

TEST_F(PortResetTest, TriesEachPortAtMostOnceAMinuteWhateverCameOfIt) {
  fake_usb().fail(UsbCall::reset, LIBUSB_ERROR_OTHER);
  EXPECT_FALSE(reset("1-2.3").done);
  now_ += 59'999ms;
  fake_usb().fail(UsbCall::reset, 0);
  const PortResetResult too_soon = reset("1-2.3");
  EXPECT_FALSE(too_soon.done);
  EXPECT_THAT(too_soon.text, HasSubstr("within a minute"));
  EXPECT_TRUE(reset("2-2.3").done) << "another port";
  now_ += 1ms;
  EXPECT_TRUE(reset("1-2.3").done);
  EXPECT_EQ(fake_usb().resets_tried, 3);
}

}  // namespace
}  // namespace azimuth
