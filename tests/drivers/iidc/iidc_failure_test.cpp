// Failures of any libdc1394 call, and cameras that disappear.

#include <cerrno>
#include <fcntl.h>
#include <gmock/gmock.h>

#include "drivers/iidc/iidc_list.hpp"
#include "tests/drivers/iidc/iidc_bench.hpp"

namespace azimuth::test {
namespace {

using testing::HasSubstr;

class IidcFailureTest : public IidcBench {
 protected:
  /// Offers and requests every feature of a camera.
  void want_everything() {
    for (int i = DC1394_FEATURE_MIN; i <= DC1394_FEATURE_MAX; ++i) {
      FakeFeature feature;
      feature.switchable = feature.absolute = true;
      feature.on = false;
      fake().features[static_cast<dc1394feature_t>(i)] = feature;
    }
    settings_.shutter = "4 ms";
    settings_.gain = "20";
    settings_.white_balance = "1 2";
    settings_.exposure = "auto";
    settings_.gamma = "off";
    settings_.rate_hz = 15;
  }
  /// Opens and reads repeatedly; each time the next call fails, until none is left. Each attempt must yield a stream or
  /// a reason, and must leave nothing open.
  void fail_every_call(int expected_at_least) {
    int failed = 0;
    for (int call = 1;; ++call) {
      fake().calls = 0;
      fake().failed_call = nullptr;
      fake().failing_call = call;
      fake().transmitting = false;
      const bool opened = open();
      if (opened) {
        fake().send(1);
        const Read result = read();
        EXPECT_TRUE(result == Read::image || result == Read::failed) << call;
        if (result == Read::failed) {
          EXPECT_THAT(stream_->trouble().text, HasSubstr("00b09d0100c0ffee"));
        } else {
          EXPECT_TRUE(is_filled_with(frame_, 1));
        }
        read();
      } else {
        EXPECT_NE(trouble_.error_number, 0) << trouble_.text;
        EXPECT_THAT(trouble_.text, HasSubstr("IIDC camera"));
      }
      stream_.reset();
      if (fake().failed_call == nullptr) break;
      EXPECT_EQ(fake().captures, 0) << fake().failed_call;
      EXPECT_EQ(fake().cameras, 0) << fake().failed_call;
      EXPECT_EQ(fake().contexts, 0) << fake().failed_call;
      ++failed;
    }
    EXPECT_GE(failed, expected_at_least);
  }
};

TEST_F(IidcFailureTest, EveryCallFailingInAFixedMode) {
  want_everything();
  fail_every_call(40);
}

TEST_F(IidcFailureTest, EveryCallFailingInFormat7) {
  want_everything();
  fake().modes = {{DC1394_VIDEO_MODE_FORMAT7_0, {}}};
  fake().format7.codings = {DC1394_COLOR_CODING_RAW8};
  fail_every_call(50);
}

TEST_F(IidcFailureTest, ACameraThatIsNotThereIsNamed) {
  fake().guids.clear();
  EXPECT_FALSE(open());
  EXPECT_EQ(trouble_.text, "IIDC camera (any): is not there");
  EXPECT_EQ(trouble_.error_number, ENODEV);
  fake().guids = {1, 2};
  settings_.guid = "00b09d0100c0ffee";
  EXPECT_FALSE(open());
  EXPECT_EQ(trouble_.text, "IIDC camera 00b09d0100c0ffee: is not there");
}

TEST_F(IidcFailureTest, TheWishedCameraOrTheLowestIsOpened) {
  fake().guids = {9, FakeIidc::kGuid, 5};
  settings_.guid = "0xB09D0100C0FFEE";
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().opened_guid, FakeIidc::kGuid);
  settings_.guid.clear();
  ASSERT_TRUE(open());
  EXPECT_EQ(fake().opened_guid, 5U);
  EXPECT_EQ(stream_->description().device, "0000000000000005");
}

TEST_F(IidcFailureTest, AllCamerasAreListedUnopened) {
  fake().guids = {9, FakeIidc::kGuid, 5};
  const IidcBus bus = list_iidc_cameras();
  EXPECT_THAT(bus.guids, testing::ElementsAre("0000000000000005", "0000000000000009", "00b09d0100c0ffee"));
  EXPECT_EQ(bus.trouble, "");
  EXPECT_EQ(fake().opened_guid, 0U);
  fake().guids.clear();
  EXPECT_THAT(list_iidc_cameras().guids, testing::IsEmpty());
}

TEST_F(IidcFailureTest, AListThatFailsSaysWhy) {
  fake().failing_call = 1;
  EXPECT_THAT(list_iidc_cameras().trouble, HasSubstr("neither FireWire nor USB"));
  fake().calls = 0;
  fake().failing_call = 2;
  const IidcBus bus = list_iidc_cameras();
  EXPECT_THAT(bus.trouble, HasSubstr("enumerating the bus"));
  EXPECT_THAT(bus.guids, testing::IsEmpty());
}

TEST_F(IidcFailureTest, ABusWithoutBandwidthIsTold) {
  fake().setup_error = DC1394_NO_BANDWIDTH;
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("no bandwidth left"));
  EXPECT_THAT(trouble_.text, HasSubstr("crashed"));
  EXPECT_EQ(trouble_.error_number, EBUSY);
  fake().setup_error = DC1394_NO_ISO_CHANNEL;
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("no isochronous channel left"));
  EXPECT_EQ(trouble_.error_number, EBUSY);
}

TEST_F(IidcFailureTest, WhatACrashedProgramLeftRunningIsStopped) {
  fake().transmitting = true;
  ASSERT_TRUE(open()) << trouble_.text;  // the stand-in accepts no mode while it transmits
}

TEST_F(IidcFailureTest, TheLibraryComplainsInTheTroubleAndNotOnStderr) {
  testing::internal::CaptureStderr();
  fake().complaint = "usb: capture thread failed to claim interface\n";
  for (int call = 1; call < 30 && fake().failed_call == nullptr; ++call) {
    fake().calls = 0;
    fake().failing_call = call;
    if (open()) stream_.reset();
    if (fake().failed_call != nullptr && std::string_view(fake().failed_call) != "dc1394_capture_setup")
      fake().failed_call = nullptr;
  }
  EXPECT_THAT(trouble_.text, HasSubstr("(usb: capture thread failed to claim interface)"));
  fake().failing_call = 0;
  fake().guids.clear();
  EXPECT_FALSE(open());
  EXPECT_EQ(trouble_.text, "IIDC camera (any): is not there");  // the earlier message must not be repeated
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(IidcFailureTest, AnUnpluggedCameraFailsOnceAndForAll) {
  ASSERT_TRUE(open());
  fake().send(1);
  ASSERT_EQ(read(), Read::image);
  fake().dequeue_error = DC1394_FAILURE;
  EXPECT_EQ(read(), Read::failed);
  EXPECT_FALSE(frame_);
  EXPECT_EQ(stream_->trouble().text, "IIDC camera 00b09d0100c0ffee: taking a frame off: generic failure");
  EXPECT_EQ(stream_->trouble().error_number, EIO);
  const int calls = fake().calls;
  EXPECT_EQ(read(), Read::failed);
  EXPECT_EQ(fake().calls, calls);  // no further calls of the library
}

TEST_F(IidcFailureTest, ARingThatTakesNothingBackFailsAfterTheImage) {
  ASSERT_TRUE(open());
  fake().enqueue_error = DC1394_IOCTL_FAILURE;
  fake().send(1);
  EXPECT_EQ(read(), Read::image);
  EXPECT_TRUE(is_filled_with(frame_, 1));
  EXPECT_EQ(read(), Read::failed);
  EXPECT_THAT(stream_->trouble().text, HasSubstr("giving a frame back"));
}

TEST_F(IidcFailureTest, ABusResetEndsTheStream) {
  ASSERT_TRUE(open());
  fake().send(1);
  ASSERT_EQ(read(), Read::image);
  EXPECT_EQ(read(), Read::nothing);
  fake().reset_bus();
  EXPECT_EQ(read(), Read::failed);
  EXPECT_EQ(stream_->trouble().text, "IIDC camera 00b09d0100c0ffee: the bus was reset");
  ASSERT_TRUE(open());
  fake().send(2);
  EXPECT_EQ(read(), Read::image);
}

TEST_F(IidcFailureTest, AnEventWithoutAResetIsNothingUnlessTheCameraHasStopped) {
  ASSERT_TRUE(open());
  fake().reset_bus();
  --fake().generation;
  EXPECT_EQ(read(), Read::nothing);
  fake().reset_bus();
  --fake().generation;
  fake().keeps_sending = false;
  EXPECT_EQ(read(), Read::failed);
  EXPECT_THAT(stream_->trouble().text, HasSubstr("stopped sending"));
}

TEST_F(IidcFailureTest, ACaptureThatCannotBeStoppedLeavesNoDescriptor) {
  ASSERT_TRUE(open());
  const int descriptor = fake().last_descriptor;
  fake().stop_error = DC1394_IOCTL_FAILURE;
  ASSERT_GE(::fcntl(descriptor, F_GETFD), 0);
  stream_.reset();
  EXPECT_LT(::fcntl(descriptor, F_GETFD), 0);
}

TEST_F(IidcFailureTest, WrongSettingsOpenNothing) {
  settings_.mode = "huge";
  EXPECT_FALSE(open());
  EXPECT_THAT(trouble_.text, HasSubstr("mode is \"huge\""));
  EXPECT_EQ(trouble_.error_number, EINVAL);
  EXPECT_EQ(fake().calls, 0);
}

}  // namespace
}  // namespace azimuth::test
