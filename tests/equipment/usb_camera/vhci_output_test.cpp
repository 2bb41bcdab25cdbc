#include "tests/equipment/usb_camera/vhci_output.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "tests/equipment/usb_camera/uvc_camera.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth::sim::test {
namespace {

/// A controller that accepts everything written to its files and closes its end of the cable at once.
struct VhciOutputTest : testing::Test {
  VhciOutputTest() {
    for (const char* file : {"attach", "detach"}) std::ofstream(folder / file);
  }
  std::string text_of(const char* file) const {
    std::ifstream stream(folder / file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static std::ptrdiff_t open_descriptors() {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
  }

  azimuth::test::TemporaryFolder folder;
  VhciOutput output{std::make_unique<UvcCamera>(32, 16, 30.0, "SN1"), 3, folder.path()};
};

TEST_F(VhciOutputTest, TellsTheKernelWhatIsPluggedInWhere) {
  EXPECT_FALSE(output.plug());
  EXPECT_TRUE(output.plugged());
  int port = -1, descriptor = -1, device = -1, speed = -1;
  std::istringstream(text_of("attach")) >> port >> descriptor >> device >> speed;
  EXPECT_EQ(port, 3);
  EXPECT_GT(descriptor, 2);
  EXPECT_NE(device, 0);
  EXPECT_EQ(speed, 3);
  EXPECT_TRUE(output.plug());
  EXPECT_FALSE(output.unplug());
  EXPECT_EQ(text_of("detach"), "3");
  EXPECT_FALSE(output.plugged());
  EXPECT_TRUE(output.unplug());
}

TEST_F(VhciOutputTest, KeepsNothingOfACableThatIsOut) {
  ASSERT_FALSE(output.plug());
  ASSERT_FALSE(output.unplug());
  const std::ptrdiff_t before = open_descriptors();
  for (int i = 0; i < 100; ++i) {
    ASSERT_FALSE(output.plug());
    if (i % 2 == 0) {
      ASSERT_FALSE(output.unplug());
    } else {
      output.turn();  // the kernel has closed its end
    }
    ASSERT_FALSE(output.plugged());
    EXPECT_EQ(output.descriptor(), -1);
  }
  EXPECT_EQ(open_descriptors(), before);
}

TEST_F(VhciOutputTest, SaysWhyItCannotPlugIn) {
  std::filesystem::remove(folder / "attach");
  const std::optional<std::string> error = output.plug();
  ASSERT_TRUE(error);
  EXPECT_NE(error->find("attach: No such file"), std::string::npos);
  EXPECT_FALSE(output.plugged());
}

}  // namespace
}  // namespace azimuth::sim::test
