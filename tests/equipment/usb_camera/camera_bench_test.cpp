#include "tests/equipment/usb_camera/camera_bench.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace azimuth::sim::test {
namespace {

constexpr WireShape kShape{WireFormat::grey, 16, 16};

/// What the output received.
struct Delivered {
  std::vector<std::uint32_t> numbers;
  std::vector<ImageFlaw> flaws;
  int plugs = 0, unplugs = 0;
};

/// Ends the bench through `bell` once it has received `wanted` images.
class ListeningOutput : public CameraOutput {
 public:
  ListeningOutput(Delivered& delivered, std::size_t wanted, int bell)
      : delivered_(delivered), wanted_(wanted), bell_(bell) {}
  std::optional<std::string> plug() override {
    if (std::exchange(plugged_, true)) return "is plugged in already";
    ++delivered_.plugs;
    return std::nullopt;
  }
  std::optional<std::string> unplug() override {
    if (!std::exchange(plugged_, false)) return "is not plugged in";
    ++delivered_.unplugs;
    return std::nullopt;
  }
  bool plugged() const override { return plugged_; }
  int descriptor() const override { return -1; }
  void turn() override {}
  bool ready() const override { return plugged_ && !frozen_; }
  WireShape shape() const override { return kShape; }
  double rate_hz() const override { return 1000.0; }
  void send(OctetSpan image, ImageFlaw flaw) override {
    delivered_.numbers.push_back(check_pattern(kShape, image).value_or(0xffffffff));
    delivered_.flaws.push_back(flaw);
    if (delivered_.numbers.size() != wanted_) return;
    EXPECT_EQ(::eventfd_write(bell_, 1), 0);
  }
  void freeze(bool frozen) override { frozen_ = frozen; }
  bool hang() override { return false; }
  std::string status() const override { return "plugged=" + std::to_string(plugged_); }

 private:
  Delivered& delivered_;
  std::size_t wanted_;
  int bell_;
  bool plugged_ = false, frozen_ = false;
};

struct CameraBenchTest : testing::Test {
  CameraBench make(std::size_t wanted) {
    return CameraBench(std::make_unique<ListeningOutput>(delivered, wanted, bell.get()),
                       std::make_unique<PatternFeed>());
  }
  Delivered delivered;
  UniqueFd bell{::eventfd(0, EFD_CLOEXEC)};
};

TEST_F(CameraBenchTest, SendsNumberedImagesUntilItIsToldToEnd) {
  CameraBench bench = make(4);
  EXPECT_EQ(bench.run(bell.get()), 0);
  ASSERT_GE(delivered.numbers.size(), 4U);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(delivered.numbers[i], i);
  EXPECT_EQ(delivered.plugs, 1);
  EXPECT_EQ(delivered.unplugs, 1);
}

TEST_F(CameraBenchTest, FaultsComeInTheirNumber) {
  CameraBench bench = make(5);
  EXPECT_EQ(bench.obey("drop 3"), "done");
  EXPECT_EQ(bench.obey("short"), "done");
  EXPECT_EQ(bench.obey("error 2"), "done");
  EXPECT_EQ(bench.run(bell.get()), 0);
  ASSERT_GE(delivered.numbers.size(), 5U);
  EXPECT_EQ(delivered.numbers[0], 3U);
  using enum ImageFlaw;
  delivered.flaws.resize(5);
  EXPECT_THAT(delivered.flaws, testing::ElementsAre(cut_short, marked_bad, marked_bad, none, none));
}

TEST_F(CameraBenchTest, SaysWhatItCannotDo) {
  CameraBench bench = make(1);
  EXPECT_EQ(bench.obey("unplug"), "is not plugged in");
  EXPECT_EQ(bench.obey("plug"), "done");
  EXPECT_EQ(bench.obey("plug"), "is plugged in already");
  EXPECT_EQ(bench.obey("hang"), "this device knows no reset");
  EXPECT_EQ(bench.obey("explode"), "is not a command");
  EXPECT_EQ(bench.obey(""), "is not a command");
  EXPECT_EQ(bench.obey("drop x"), "is not understood");
  EXPECT_EQ(bench.obey("drop 3 4"), "is not understood");
  EXPECT_EQ(bench.obey("drop -1"), "is not understood");
}

}  // namespace
}  // namespace azimuth::sim::test
