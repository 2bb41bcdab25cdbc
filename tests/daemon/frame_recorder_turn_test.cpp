// FrameRecorderTurn: an image waits for its pose, but only for a moment.

#include <gtest/gtest.h>

#include "daemon/pipeline/background_turns.hpp"
#include "slam/sample/image.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

class FrameRecorderTurnTest : public testing::Test {
 protected:
  FrameRecorderTurnTest() { recorder_.begin("session"); }

  RecordSettings settings() const {
    RecordSettings settings;
    settings.folder = folder_.path();
    settings.min_free_mb = 0.0;
    settings.frames = RecordedFrames::raw;
    return settings;
  }
  void give(Stamp stamp) {
    const FrameFormat format = packed_format(PixelFormat::gray8, 16, 12);
    KeptImage image{.stamp = stamp, .format = format, .bytes = std::vector<std::byte>(format.bytes())};
    ASSERT_TRUE(images_.push(image));
  }
  /// Number of recorded events after one turn that the bell woke.
  std::uint64_t recorded() {
    bell_.ring();
    turn_();
    return recorder_.status().events;
  }

  test::TemporaryFolder folder_;
  Doorbell bell_;
  ImagesWire images_{bell_};
  Newest<std::string> session_{bell_};
  PosesOut poses_out_{bell_};
  Newest<RecordStatus> status_{bell_};
  FrameRecorder recorder_{settings(), EventTimes::of_recording(Stamp{})};
  FrameRecorderTurn turn_{recorder_, {images_, session_, poses_out_, status_}, bell_};
};

TEST_F(FrameRecorderTurnTest, AnImageIsRecordedWhenItsPoseIsOut) {
  give(Stamp{1s});
  give(Stamp{2s});
  EXPECT_EQ(recorded(), 0U);
  poses_out_.tell(Stamp{1s});
  EXPECT_EQ(recorded(), 1U);
  EXPECT_EQ(recorded(), 1U);
  poses_out_.tell(Stamp{2s});
  EXPECT_EQ(recorded(), 2U);
}

TEST_F(FrameRecorderTurnTest, OneOfWhichNoPoseComesIsRecordedAMomentLater) {
  give(Stamp{1s});
  ASSERT_EQ(recorded(), 0U);
  const auto since = std::chrono::steady_clock::now();
  while (recorder_.status().events == 0 && std::chrono::steady_clock::now() < since + 5s) turn_();
  EXPECT_EQ(recorder_.status().events, 1U);
}

TEST_F(FrameRecorderTurnTest, NoneWaitsWhenTheRingFillsUp) {
  for (int i = 1; i <= static_cast<int>(kImagesRing); ++i) give(Stamp{i * 1s});
  EXPECT_GE(recorded(), kImagesRing / 2);
}

TEST_F(FrameRecorderTurnTest, NoneIsLeftOnceAllPosesAreOut) {
  for (int i = 1; i <= static_cast<int>(kImagesRing); ++i) give(Stamp{i * 1s});
  poses_out_.tell(Stamp::max());
  EXPECT_EQ(recorded(), kImagesRing);
}

}  // namespace
}  // namespace azimuth
