#include <cerrno>
#include <fstream>
#include <gmock/gmock.h>

#include "drivers/v4l2/v4l2_finder.hpp"
#include "drivers/v4l2/v4l2_stream.hpp"
#include "tests/drivers/v4l2/fake_v4l2.hpp"

namespace azimuth {
namespace {

using testing::HasSubstr;

class V4l2FinderTest : public testing::Test {
 protected:
  /// The node that was opened, or the error text.
  std::string found(const std::string& name) {
    const auto opened = v4l2::open_named(device_, name);
    if (!opened) return opened.error().text;
    return device_.opened_node;
  }

  test::FakeV4l2 device_;
};

TEST_F(V4l2FinderTest, FindsByPathAndThroughSymbolicLinks) {
  const std::string node = (device_.nodes() / "video0").string();
  EXPECT_EQ(found(node), "video0");
  std::filesystem::create_symlink(node, device_.nodes() / "omnicam");
  EXPECT_EQ(found((device_.nodes() / "omnicam").string()), "video0");
  EXPECT_EQ(v4l2::usb_port(device_, device_.nodes() / "omnicam"), "1-2");
  EXPECT_THAT(found("/nonexistent/video0"), HasSubstr("/nonexistent/video0: open: No such file or directory"));
}

TEST_F(V4l2FinderTest, FindsWhatIsMeantAmongMany) {
  device_.add_node("video10", "1-4.1", "046d", "0825", "A1");
  device_.add_node("video2", "1-4.2", "046d", "0825", "B2");
  device_.add_node("video3", "", "", "");
  EXPECT_EQ(found("first"), "video0");
  EXPECT_EQ(found("usb:046d:0825"), "video2") << "the lowest number";
  EXPECT_EQ(found("usb:046d:0825:A1"), "video10");
  EXPECT_EQ(found("serial:A1"), "video10");
  EXPECT_EQ(found("card:Fake Camera"), "video0");
  EXPECT_THAT(found("serial:C3"), HasSubstr("no such camera"));
  EXPECT_THAT(found("usb:046d:0826"), HasSubstr("no such camera"));
  EXPECT_THAT(found("card:Other"), HasSubstr("no such camera"));
  EXPECT_EQ(v4l2::usb_port(device_, device_.nodes() / "video2"), "1-4.2");
  EXPECT_EQ(v4l2::usb_port(device_, device_.nodes() / "video3"), "");
}

TEST_F(V4l2FinderTest, PassesOverNodesThatGiveNoImages) {
  device_.add_node("video1", "1-2");
  device_.set_metadata("video0");
  EXPECT_EQ(found("first"), "video1");
  EXPECT_EQ(device_.open_descriptors(), 0);
}

TEST_F(V4l2FinderTest, SaysWhyTheOneThatMatchesDoesNotOpen) {
  device_.open_error = EACCES;
  EXPECT_THAT(found("usb:1d6b:0105"), HasSubstr("video0: open: Permission denied"));
  device_.remove_node("video0");
  EXPECT_THAT(found("usb:1d6b:0105"), HasSubstr("usb:1d6b:0105: no such camera"));
}

TEST_F(V4l2FinderTest, ListsAllNodesAndClosesThemAgain) {
  device_.add_node("video10", "1-4.1", "046d", "0825", "A1");
  device_.add_node("video2", "", "", "");
  device_.set_metadata("video2");
  const std::vector<v4l2::VideoNode> nodes = v4l2::video_nodes(device_);
  ASSERT_EQ(nodes.size(), 3U);
  EXPECT_EQ(nodes[0].path, (device_.nodes() / "video0").string());
  EXPECT_EQ(nodes[0].card, "Fake Camera");
  EXPECT_EQ(nodes[0].open_error, 0);
  EXPECT_EQ(nodes[0].gives_images, true);
  EXPECT_EQ(nodes[1].gives_images, false);
  EXPECT_EQ(nodes[1].usb.port, "");
  EXPECT_EQ(nodes[2].usb.port, "1-4.1");
  EXPECT_EQ(nodes[2].usb.vendor + ":" + nodes[2].usb.product + ":" + nodes[2].usb.serial, "046d:0825:A1");
  EXPECT_EQ(device_.open_descriptors(), 0);
}

TEST_F(V4l2FinderTest, WhatMayNotBeOpenedIsListedAsSysfsHasIt) {
  device_.open_error = EACCES;
  std::ofstream(device_.classes() / "video0" / "name") << "Named Camera\n";
  std::vector<v4l2::VideoNode> nodes = v4l2::video_nodes(device_);
  ASSERT_EQ(nodes.size(), 1U);
  EXPECT_EQ(nodes[0].open_error, EACCES);
  EXPECT_EQ(nodes[0].card, "Named Camera");
  EXPECT_EQ(nodes[0].gives_images, std::nullopt);
  EXPECT_TRUE(v4l2::is_meant("first", nodes[0]));
  device_.open_error = 0;
  device_.failing[VIDIOC_QUERYCAP] = ENODEV;
  nodes = v4l2::video_nodes(device_);
  ASSERT_EQ(nodes.size(), 1U);
  EXPECT_EQ(nodes[0].gives_images, std::nullopt);
  EXPECT_EQ(device_.open_descriptors(), 0);
  device_.remove_node("video0");
  EXPECT_TRUE(v4l2::video_nodes(device_).empty());
}

TEST_F(V4l2FinderTest, TheLastingNameMeansThisCameraAlone) {
  const auto camera = [](const char* path, const char* card, v4l2::UsbIdentity usb) {
    return v4l2::VideoNode{.path = path, .card = card, .usb = std::move(usb), .gives_images = true};
  };
  std::vector<v4l2::VideoNode> all{camera("/dev/video0", "A", {"1-1", "046d", "0825", "SN1"}),
                                   camera("/dev/video1", "A", {"1-1", "046d", "0825", "SN1"}),
                                   camera("/dev/video2", "A", {"1-2", "046d", "0825", "SN2"}),
                                   camera("/dev/video3", "A", {"1-3", "1d6b", "0105", "SN2"}),
                                   camera("/dev/video4", "A", {"1-4", "1d6b", "0106", ""}),
                                   camera("/dev/video5", "B", {}),
                                   camera("/dev/video6", "C", {}),
                                   camera("/dev/video7", "C", {})};
  all[1].gives_images = false;
  EXPECT_EQ(v4l2::lasting_name(all[0], all), "serial:SN1") << "its node of metadata does not count";
  EXPECT_EQ(v4l2::lasting_name(all[2], all), "usb:046d:0825:SN2") << "another make has the same serial number";
  EXPECT_EQ(v4l2::lasting_name(all[3], all), "usb:1d6b:0105");
  EXPECT_EQ(v4l2::lasting_name(all[4], all), "usb:1d6b:0106");
  EXPECT_EQ(v4l2::lasting_name(all[5], all), "card:B");
  EXPECT_EQ(v4l2::lasting_name(all[6], all), "/dev/video6") << "nothing tells them apart";
  EXPECT_FALSE(v4l2::is_meant("/dev/video0", all[0])) << "paths are the caller's";
  EXPECT_FALSE(v4l2::is_meant("video0", all[0]));
}

TEST_F(V4l2FinderTest, NamesAreParsedStrictly) {
  EXPECT_TRUE(v4l2::parse_name("usb:046d:0825:with:colons"));
  for (const char* const wrong : {"", "video0", "usb:", "usb:046d", "usb:46d:0825", "usb:046D:0825",
                                  "serial:", "card:", "usb:046d:0825x", "bus:1"})
    EXPECT_FALSE(v4l2::parse_name(wrong)) << wrong;
}

}  // namespace
}  // namespace azimuth
