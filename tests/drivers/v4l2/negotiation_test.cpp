#include <gmock/gmock.h>

#include "drivers/v4l2/v4l2_stream.hpp"
#include "tests/drivers/v4l2/fake_v4l2.hpp"

namespace azimuth {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class V4l2NegotiationTest : public testing::Test {
 protected:
  const StreamDescription& open(const V4l2Settings& settings) {
    opened_ = open_v4l2(settings, device_);
    EXPECT_TRUE(opened_) << opened_.error().text;
    static const StreamDescription kNone;
    return opened_ ? (*opened_)->description() : kNone;
  }
  CameraTrouble refusal(const V4l2Settings& settings) {
    opened_ = open_v4l2(settings, device_);
    EXPECT_FALSE(opened_);
    EXPECT_EQ(device_.open_descriptors(), 0);
    return opened_.error();
  }

  test::FakeV4l2 device_;
  OpenedStream opened_;
};

TEST_F(V4l2NegotiationTest, TakesWhatCostsLeastAndHasTheSize) {
  device_.formats = {{V4L2_PIX_FMT_MJPEG, 0}, {V4L2_PIX_FMT_YUYV, 2}, {V4L2_PIX_FMT_GREY, 1, 30.0, {{320, 240}}}};
  EXPECT_EQ(open({.width_px = 640, .height_px = 480}).format, packed_format(PixelFormat::yuyv, 640, 480));
  EXPECT_EQ(open({.width_px = 320, .height_px = 240}).format, packed_format(PixelFormat::gray8, 320, 240));
  EXPECT_EQ(open({.width_px = 320, .height_px = 240, .wants_colour = true}).format.pixels, PixelFormat::yuyv);
  EXPECT_EQ(open({.formats = "MJPG,GREY"}).format.pixels, PixelFormat::mjpeg);
}

TEST_F(V4l2NegotiationTest, KeepsTheSizeThatIsSetWhenNoneIsAskedFor) {
  EXPECT_EQ(open({}).format.width_px, 640);
  open({.width_px = 320, .height_px = 240});
  EXPECT_EQ(open({}).format.width_px, 320);
}

TEST_F(V4l2NegotiationTest, PrefersAFormatThatReachesTheRate) {
  device_.formats = {{V4L2_PIX_FMT_YUYV, 2, 5.0}, {V4L2_PIX_FMT_MJPEG, 0, 30.0}};
  EXPECT_EQ(open({.rate_hz = 15.0}).format.pixels, PixelFormat::mjpeg);
  EXPECT_DOUBLE_EQ((*opened_)->description().rate_hz, 15.0);
  EXPECT_THAT((*opened_)->description().refused, IsEmpty());
  EXPECT_EQ(open({.rate_hz = 5.0}).format.pixels, PixelFormat::yuyv);
  EXPECT_EQ(open({.rate_hz = 60.0}).format.pixels, PixelFormat::yuyv) << "none reaches it";
  EXPECT_THAT((*opened_)->description().refused, ElementsAre("runs at 5 Hz, asked for 60 Hz"));
}

TEST_F(V4l2NegotiationTest, ADeviceWithoutRatesIsLeftAlone) {
  device_.has_rates = false;
  EXPECT_EQ(open({}).rate_hz, 0.0);
  EXPECT_THAT((*opened_)->description().refused, IsEmpty());
  EXPECT_THAT(open({.rate_hz = 15.0}).refused, ElementsAre("does not say its rate, asked for 15 Hz"));
  device_.has_rates = true;
  device_.failing[VIDIOC_S_PARM] = EIO;
  EXPECT_THAT(open({.rate_hz = 15.0}).refused, testing::Contains(HasSubstr("does not take a rate")));
}

TEST_F(V4l2NegotiationTest, AnotherSizeIsRefusedAndTheOffersAreNamed) {
  const CameraTrouble trouble = refusal({.width_px = 1024, .height_px = 768});
  EXPECT_THAT(trouble.text, HasSubstr("video0: gives no images of 1024x768 in a format that can be read, but "
                                      "YUYV 640x480, MJPG 640x480"));
}

TEST_F(V4l2NegotiationTest, AFormatNobodyReadsIsRefused) {
  device_.formats = {{V4L2_PIX_FMT_H264, 0}};
  EXPECT_THAT(refusal({}).text, HasSubstr("has none of the formats wanted, but H264"));
  device_.formats = {{V4L2_PIX_FMT_YUYV, 2}};
  EXPECT_THAT(refusal({.formats = "GREY"}).text, HasSubstr("but YUYV"));
}

TEST_F(V4l2NegotiationTest, PaddedRowsAndPlanesAreUnderstood) {
  device_.padding_bytes = 64;
  EXPECT_EQ(open({}).format.stride_bytes, 1280 + 64);
  device_.capabilities = V4L2_CAP_VIDEO_CAPTURE_MPLANE | V4L2_CAP_STREAMING;
  device_.formats = {{V4L2_PIX_FMT_NV12, 1}};
  EXPECT_EQ(open({}).format, (FrameFormat{PixelFormat::nv12, 640, 480, 640 + 64}));
}

TEST_F(V4l2NegotiationTest, InterlacedImagesAreTold) {
  device_.field = V4L2_FIELD_INTERLACED;
  EXPECT_THAT(open({}).refused, ElementsAre("gives interlaced images"));
}

TEST_F(V4l2NegotiationTest, AnotherUserOfTheCameraIsNamedAsTheReason) {
  device_.failing[VIDIOC_S_FMT] = EBUSY;
  const CameraTrouble trouble = refusal({});
  EXPECT_THAT(trouble.text, HasSubstr("VIDIOC_S_FMT: Device or resource busy"));
  EXPECT_EQ(trouble.error_number, EBUSY);
}

}  // namespace
}  // namespace azimuth
