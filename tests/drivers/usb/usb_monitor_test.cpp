#include "drivers/usb/usb_monitor.hpp"

#include <gmock/gmock.h>
#include <poll.h>
#include <sys/eventfd.h>

#include "tests/drivers/usb/fake_libusb.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using test::fake_usb;
using test::UsbCall;
using testing::HasSubstr;
using testing::IsEmpty;

class UsbMonitorTest : public ::testing::Test {
 protected:
  UsbMonitorTest() { test::reset_fake_usb(); }
  void TearDown() override { EXPECT_EQ(fake_usb().contexts, 0) << "each context is closed"; }

  static bool readable(const UsbMonitor& monitor) {
    pollfd ready{.fd = monitor.descriptor(), .events = POLLIN, .revents = 0};
    return ::poll(&ready, 1, 0) == 1;
  }
  static std::vector<UsbEvent> all(UsbMonitor& monitor) {
    std::vector<UsbEvent> events;
    UsbEvent event;
    while (monitor.take(event)) events.push_back(event);
    return events;
  }
};

TEST_F(UsbMonitorTest, TellsWhatComesAndGoes) {
  UsbMonitor monitor;
  EXPECT_THAT(monitor.trouble(), IsEmpty());
  EXPECT_FALSE(readable(monitor));
  fake_usb().plug_in({1, {2, 3}, 0x0403, 0x6001});
  fake_usb().unplug({1, {2, 3}, 0x0403, 0x6001});
  fake_usb().plug_in({2, {1}, 0x046d, 0x0825});
  EXPECT_TRUE(readable(monitor));
  monitor.turn();
  EXPECT_FALSE(readable(monitor));
  const std::vector<UsbEvent> events = all(monitor);
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].kind, UsbEvent::Kind::arrived);
  EXPECT_EQ(events[0].port, "1-2.3");
  EXPECT_EQ(events[0].vendor, 0x0403);
  EXPECT_EQ(events[0].product, 0x6001);
  EXPECT_EQ(events[1].kind, UsbEvent::Kind::left);
  EXPECT_EQ(events[2].port, "2-1");
}

TEST_F(UsbMonitorTest, TwoMonitorsHearTheSame) {
  UsbMonitor one, other;
  fake_usb().plug_in({1, {4}});
  one.turn();
  other.turn();
  EXPECT_EQ(all(one).size(), 1U);
  EXPECT_EQ(all(other).size(), 1U);
}

TEST_F(UsbMonitorTest, LeavesOutRootHubsAndWhatCannotBeDescribed) {
  UsbMonitor monitor;
  fake_usb().plug_in({1, {}});
  monitor.turn();
  EXPECT_THAT(all(monitor), IsEmpty());
  fake_usb().fail(UsbCall::describe, LIBUSB_ERROR_IO);
  fake_usb().plug_in({1, {1}});
  monitor.turn();
  EXPECT_THAT(all(monitor), IsEmpty());
  fake_usb().fail(UsbCall::describe, 0);
  fake_usb().plug_in({1, {1}});
  monitor.turn();
  EXPECT_EQ(all(monitor).size(), 1U) << "still registered";
}

TEST_F(UsbMonitorTest, KeepsTheNewestOfManyEvents) {
  UsbMonitor monitor;
  const std::size_t many = UsbMonitor::kMaxUntaken + 5;
  for (std::size_t i = 1; i <= many; ++i) fake_usb().plug_in({1, {static_cast<std::uint8_t>(i)}});
  monitor.turn();
  const std::vector<UsbEvent> events = all(monitor);
  ASSERT_EQ(events.size(), UsbMonitor::kMaxUntaken);
  EXPECT_EQ(events.back().port, "1-" + std::to_string(many));
}

TEST_F(UsbMonitorTest, FollowsTheDescriptorsOfTheLibrary) {
  UsbMonitor monitor;
  const UniqueFd another(::eventfd(1, EFD_NONBLOCK | EFD_CLOEXEC));
  fake_usb().add_descriptor(another.get());
  EXPECT_TRUE(readable(monitor));
  fake_usb().remove_descriptor(another.get());
  EXPECT_FALSE(readable(monitor));
}

TEST_F(UsbMonitorTest, SaysWhyItCannotTell) {
  for (const auto& [call, words] : {std::pair{UsbCall::init, "libusb_init: Other error"},
                                    {UsbCall::hotplug, "this system does not tell of it"},
                                    {UsbCall::subscribe, "libusb_hotplug_register_callback: Other error"},
                                    {UsbCall::descriptors, "descriptors cannot be had"}}) {
    fake_usb().fail(call, LIBUSB_ERROR_OTHER);
    UsbMonitor monitor;
    EXPECT_THAT(monitor.trouble(), HasSubstr(words));
    EXPECT_EQ(monitor.descriptor(), -1);
    EXPECT_EQ(fake_usb().contexts, 0);
    fake_usb().plug_in({1, {1}});
    monitor.turn();
    EXPECT_THAT(all(monitor), IsEmpty());
  }
}

TEST_F(UsbMonitorTest, EndsForGoodWhenTheLibraryFailsLater) {
  UsbMonitor monitor;
  fake_usb().fail(UsbCall::handle_events, LIBUSB_ERROR_INTERRUPTED);
  monitor.turn();
  EXPECT_NE(monitor.descriptor(), -1) << "an interruption is no failure";
  fake_usb().fail(UsbCall::handle_events, LIBUSB_ERROR_OTHER);
  monitor.turn();
  EXPECT_EQ(monitor.descriptor(), -1);
  EXPECT_THAT(monitor.trouble(), HasSubstr("libusb_handle_events"));
  monitor.turn();
}

TEST_F(UsbMonitorTest, AllocatesNothingWhileNothingHappens) {
  UsbMonitor monitor;
  UsbEvent event;
  monitor.turn();
  const std::size_t before = allocations();
  for (int i = 0; i < 100; ++i) {
    monitor.turn();
    EXPECT_FALSE(monitor.take(event));
  }
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace azimuth
