// The images of a recording go through the threads at any speed and give the result of a replay without threads.

#include <chrono>
#include <gtest/gtest.h>
#include <ostream>
#include <thread>

#include "daemon/pipeline/pipeline.hpp"
#include "tests/daemon/fake_estimator.hpp"
#include "tests/daemon/fake_perception.hpp"
#include "tests/daemon/quiet.hpp"
#include "tests/daemon/small_frames.hpp"
#include "tests/daemon/small_run.hpp"
#include "tests/support/printed_name.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::kSmallFrame;

/// The images of a recording, one row of pixels each.
struct RecordedImages {
  std::vector<std::vector<std::byte>> files;

  ReadFrame reader() const {
    return [this](std::size_t index) { return ImageView{kSmallFrame, files.at(index)}; };
  }
};

/// A recording with the odometry of small_recording() and images in place of its bearings. Some images are unreadable.
std::pair<Recording, RecordedImages> recorded_images(double duration_s) {
  std::pair<Recording, RecordedImages> made{test::small_recording(duration_s), {}};
  auto& [recording, images] = made;
  for (const BearingSet& set : recording.bearings) {
    recording.frames.push_back(set.stamp);
    std::vector<std::byte>& file = images.files.emplace_back(kSmallFrame.bytes());
    file[0] = static_cast<std::byte>(images.files.size() % 6);
    for (std::size_t k = 1; k < 6; ++k) file[k] = static_cast<std::byte>(7 * images.files.size() + 40 * k);
    if (images.files.size() % 10 == 9) file.clear();
  }
  recording.bearings.clear();
  return made;
}

/// The replay without threads, which every playing of the images must match.
test::Replayed replay_images(const Recording& recording, const RecordedImages& images) {
  Recording seen = recording;
  test::FakePerception perception;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    BearingSet& set = seen.bearings.emplace_back();
    perception.observe(images.reader()(i), set);
    set.stamp = recording.frames[i];
    set.sequence = i;
  }
  seen.frames.clear();
  return test::replay(std::move(seen), std::make_unique<test::FakeEstimator>());
}

struct Played {
  double speed;
  std::chrono::microseconds detect;  ///< Time to find the bearings in an image
};
std::ostream& operator<<(std::ostream& out, const Played& played) {
  return out << "speed " << played.speed << ", " << played.detect.count() << " us an image";
}

class PlayedFrames : public ::testing::TestWithParam<Played> {};

TEST_P(PlayedFrames, GiveWhatAReplayWithoutThreadsGivesAtEverySpeed) {
  const auto [speed, detect] = GetParam();
  const auto [recording, images] = recorded_images(60.0);
  const test::Replayed expected = replay_images(recording, images);
  ASSERT_EQ(expected.estimates.size(), recording.frames.size());
  std::vector<std::unique_ptr<Source>> sources;
  sources.push_back(std::make_unique<PlayedSource>(recording, speed, images.reader()));
  const auto think = [time = detect](const ImageView&) { std::this_thread::sleep_for(time); };
  Doorbell bell;
  Pipeline pipeline({.sources = std::move(sources),
                     .perception = PerceptionStage(std::make_unique<test::FakePerception>(think), PixelFormat::gray8),
                     .estimator = EstimatorStage(std::make_unique<test::FakeEstimator>(), Rig{}, StageSettings{}),
                     .publisher = Publisher(quiet())},
                    ThreadSettings{}, bell);
  pipeline.start();
  for (int i = 0; i < 600 && !pipeline.finished(); ++i) bell.wait(100ms);
  pipeline.stop();
  EXPECT_EQ(pipeline.losses().frames_replaced, 0U);
  EXPECT_EQ(pipeline.digest().estimates(), recording.frames.size());
  EXPECT_EQ(digest_text(pipeline.digest().value()), digest_text(expected.digest.value()));
  Status status;
  ASSERT_TRUE(pipeline.take_status(status));
  EXPECT_EQ(status.samples_lost(), 0U);
}

INSTANTIATE_TEST_SUITE_P(All, PlayedFrames,
                         ::testing::Values(Played{0.0, 0us}, Played{0.0, 900us}, Played{100.0, 100us}),
                         test::PrintedName());
}  // namespace
}  // namespace azimuth
