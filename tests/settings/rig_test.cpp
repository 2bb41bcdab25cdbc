#include "settings/rig.hpp"

#include <filesystem>
#include <gmock/gmock.h>

#include "tests/support/data.hpp"

namespace azimuth {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr std::string_view kMirror = R"(front_end = "sift"
[camera]
model = "hyperbolic_mirror"
width_px = 1024
height_px = 768
centre_px = [512.0, 384.0]
azimuth_direction = -1
azimuth_offset_rad = -1.570796327
viewpoint_height_m = 1.0
mirror_a_mm = 28.095
mirror_b_mm = 23.4125
focal_length_px = 1035.376
mask_inner_px = 60.0
mask_outer_px = 376.0
[odometry]
kind = "wheel_pose"
lambda_distance_m = 9e-4
)";

TEST(RigFile, KeepsCameraAndOdometry) {
  const Outcome<Rig> rig = read_rig(kMirror, "rig.toml");
  ASSERT_TRUE(rig) << text(rig.violations());
  EXPECT_EQ(rig->front_end, FrontEnd::sift);
  EXPECT_EQ(rig->camera.model, "hyperbolic_mirror");
  EXPECT_EQ(rig->camera.image.width_px, 1024);
  EXPECT_EQ(rig->camera.image.centre_px, (PixelPoint{512.0, 384.0}));
  EXPECT_EQ(rig->camera.image.mirror_b_mm, 23.4125);
  EXPECT_EQ(rig->camera.image.theta_max_rad, std::nullopt);
  EXPECT_EQ(rig->odometry.lambda_distance_m, 9e-4);
  EXPECT_EQ(rig->odometry.scale_turn, OdometryRig{}.scale_turn);
}

TEST(RigFile, AsksForWhatTheModelNeeds) {
  const Outcome<Rig> rig = read_rig("[camera]\nmodel = \"pajdla\"\na_px = 1\nb = 1\nc_px = 1\n", "rig.toml");
  ASSERT_FALSE(rig);
  EXPECT_THAT(text(rig.violations()), HasSubstr("camera model \"pajdla\" needs the key 'centre_px' in [camera]"));
  EXPECT_THAT(rig.violations(), SizeIs(3)) << text(rig.violations());
}

TEST(RigFile, ChecksKeysAgainstEachOther) {
  const Outcome<Rig> rig =
      read_rig("[camera]\nazimuth_direction = 0\nmask_inner_px = 5\nmask_outer_px = 4\n", "rig.toml");
  ASSERT_FALSE(rig);
  EXPECT_THAT(rig.violations(), SizeIs(2)) << text(rig.violations());
}

TEST(RigFile, HintsAtTheUnitOfTheBearingNoise) {
  const Outcome<Rig> rig = read_rig("[camera]\nsigma_bearing_deg = 2.5\n", "rig.toml");
  ASSERT_FALSE(rig);
  EXPECT_THAT(text(rig.violations()), HasSubstr("rig.toml:2:1: unknown key 'sigma_bearing_deg' in [camera]; the key is "
                                                "'sigma_bearing_rad', in rad: 2.5 deg is 0.0436332 rad"));
}

TEST(RigFile, NamesAFileThatCannotBeRead) {
  const Outcome<Rig> rig = read_rig_file("no/such/rig.toml");
  ASSERT_FALSE(rig);
  EXPECT_EQ(text(rig.violations()), "no/such/rig.toml: cannot be read: No such file or directory\n");
}

TEST(RigFile, DefaultsLieInTheirRanges) {
  Rig rig;
  for (const Section& section : rig_sections(rig)) {
    for (const Key& key : section.keys) {
      EXPECT_FALSE(key.help.empty()) << key.name;
      EXPECT_TRUE(key.in_range()) << key.name << " = " << key.value_text();
    }
  }
}

TEST(RigFile, ReadsEveryRecordedRig) {
  const std::filesystem::path data = test::data_folder();
  AZIMUTH_REQUIRE_DATA("");
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    if (entry.path().filename() != "rig.toml") continue;
    const Outcome<Rig> rig = read_rig_file(entry.path());
    EXPECT_TRUE(rig) << text(rig.violations());
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace azimuth
