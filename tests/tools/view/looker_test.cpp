#include "tools/view/looker.hpp"

#include <array>
#include <gmock/gmock.h>

#include "tests/tools/view/shown.hpp"

namespace azimuth::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::StartsWith;

class LookerTest : public ShownTest {
 protected:
  std::vector<SeenEvent> read(Looker& looker, std::size_t block = 1000) {
    std::vector<char> room(block);
    while (const std::size_t count = looker.read(room)) text_.append(room.data(), count);
    return take_events(text_);
  }
  /// Passes the poses of a drive at 10 m/s to the view, 20 per second.
  void drive(int poses) {
    for (int i = 0; i < poses; ++i) {
      pose_cov_t pose = a_pose(50 * driven_++);
      pose.x_m = 0.5 * static_cast<double>(driven_);
      view_.take_pose(pose, now());
      pass(50ms);
    }
  }
  std::string text_;
  std::int64_t driven_ = 0;
};

TEST_F(LookerTest, IsGreetedBeforeAnythingCame) {
  Looker looker(view_, lookers_);
  const auto events = read(looker);
  EXPECT_THAT(names_of(events), ElementsAre("hello"));
  EXPECT_TRUE(events[0].data["epoch_us"].is_null());
  EXPECT_FALSE(looker.has_something());
}

TEST_F(LookerTest, IsToldTheWholeWayThenTheNewest) {
  drive(5000);
  Looker looker(view_, lookers_);
  const auto events = read(looker);
  EXPECT_THAT(names_of(events), ElementsAre("hello", "trail", "trail", "trail", "pose"));
  EXPECT_EQ(events[1].data["t"].size() + events[2].data["t"].size() + events[3].data["t"].size(), 5000U);
  EXPECT_EQ(events[1].data["odom_heading"].size(), 2000U);
  EXPECT_EQ(events[4].data["seq"], 4999 * 50);
}

TEST_F(LookerTest, ThenFollowsWhatHappens) {
  drive(3);
  Looker looker(view_, lookers_);
  read(looker);
  drive(1);
  EXPECT_TRUE(looker.has_something());
  EXPECT_THAT(names_of(read(looker)), ElementsAre("pose"));
}

TEST_F(LookerTest, ASlowOneGetsTheNewestAndKnowsWhatItMissed) {
  drive(1);
  Looker looker(view_, lookers_);
  read(looker);
  drive(100);
  const auto events = read(looker);
  ASSERT_THAT(names_of(events), ElementsAre("missed", "pose"));
  EXPECT_EQ(events[0].data["n"], 99);
  EXPECT_EQ(events[1].data["seq"], 100 * 50);
}

TEST_F(LookerTest, OneThatReadsByteByByteGetsTheSame) {
  drive(10);
  Looker slow(view_, lookers_), fast(view_, lookers_);
  const auto slowly = names_of(read(slow, 1));
  EXPECT_EQ(slowly, names_of(read(fast, 100'000)));
}

TEST_F(LookerTest, BeginsAnewWithADaemonThatDoes) {
  drive(20);
  Looker looker(view_, lookers_);
  read(looker);
  view_.restart(now());
  driven_ = 0;
  drive(1);
  const auto names = names_of(read(looker));
  EXPECT_THAT(names, ElementsAre("restarted", "hello", "trail", "journal", "pose"));
}

TEST_F(LookerTest, HelloComesAgainWhenTheRigIsKnown) {
  drive(1);
  Looker looker(view_, lookers_);
  read(looker);
  view_.take_rig(kRig, now());
  EXPECT_THAT(names_of(read(looker)), ElementsAre("hello", "trail", "pose"));
}

TEST_F(LookerTest, ThatGoesIsToldNothingMore) {
  {
    Looker looker(view_, lookers_);
    EXPECT_EQ(lookers_.size(), 2U);
  }
  EXPECT_EQ(lookers_.size(), 1U);
  drive(1);
}

}  // namespace
}  // namespace azimuth::test
