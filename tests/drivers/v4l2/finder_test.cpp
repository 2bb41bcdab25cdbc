#include <gmock/gmock.h>

#include "drivers/v4l2/v4l2_finder.hpp"
#include "drivers/v4l2/v4l2_stream.hpp"
#include "tests/drivers/v4l2/fake_v4l2.hpp"

namespace azimuth {
namespace {

using testing::HasSubstr;

class V4l2FinderTest : public testing::Test {
 protected:
  /// The node found, or the trouble.
  std::string found(const std::string& name) {
    const auto opened = v4l2::open_named(device_, name);
    if (const auto* const trouble = std::get_if<CameraTrouble>(&opened)) return trouble->text;
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

TEST_F(V4l2FinderTest, NamesAreParsedStrictly) {
  EXPECT_TRUE(v4l2::parse_name("usb:046d:0825:with:colons"));
  for (const char* const wrong : {"", "video0", "usb:", "usb:046d", "usb:46d:0825", "usb:046D:0825",
                                  "serial:", "card:", "usb:046d:0825x", "bus:1"})
    EXPECT_FALSE(v4l2::parse_name(wrong)) << wrong;
}

}  // namespace
}  // namespace azimuth
