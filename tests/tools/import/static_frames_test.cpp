#include "tools/import/static_frames.hpp"

#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

Eigen::Isometry3d transform(double x_m, double y_m, double z_m, double yaw_rad = 0.0) {
  return Eigen::Translation3d(x_m, y_m, z_m) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ());
}

TEST(StaticFrames, GoUpAndDownTheTree) {
  StaticFrames frames;
  frames.add("footprint", "base", transform(0.0, 0.0, 0.1));
  frames.add("base", "mast", transform(0.2, 0.0, 0.5, kPi / 2.0));
  frames.add("mast", "camera", transform(0.1, 0.0, 0.3));
  const auto T_base_camera = frames.between("base", "camera");
  ASSERT_TRUE(T_base_camera);
  EXPECT_TRUE(T_base_camera->translation().isApprox(Eigen::Vector3d(0.2, 0.1, 0.8), 1e-12));
  const auto T_camera_footprint = frames.between("camera", "footprint");
  ASSERT_TRUE(T_camera_footprint);
  EXPECT_TRUE(T_camera_footprint->inverse().translation().isApprox(Eigen::Vector3d(0.2, 0.1, 0.9), 1e-12));
}

TEST(StaticFrames, OfSeveralRootsOrOfNoneHaveNothingBetweenThem) {
  StaticFrames frames;
  frames.add("base", "camera", transform(0.2, 0.0, 0.5));
  frames.add("map", "tag", transform(1.0, 0.0, 0.0));
  EXPECT_FALSE(frames.between("base", "tag"));
  frames.add("a", "b", transform(1.0, 0.0, 0.0));
  frames.add("b", "a", transform(1.0, 0.0, 0.0));
  EXPECT_FALSE(frames.between("a", "camera")) << "a frame that is its own parent";
}

TEST(CameraMounting, GoesIntoARigThatIsSilent) {
  const CameraMounting mounting{"base_link", "camera", {0.12, -0.03, 0.9}};
  Rig rig;
  const std::string plain = "[camera]\nmodel = \"bearings\"\nsigma_bearing_rad = 0.02\n";
  const auto text = rig_with(mounting, plain);
  ASSERT_TRUE(text);
  const auto read = read_rig(*text, "rig.toml");
  ASSERT_TRUE(read) << azimuth::text(read.error());
  EXPECT_EQ(read->camera.position_m, (std::array{0.12, -0.03}));
  EXPECT_EQ(read->camera.sigma_bearing_rad, 0.02);
  EXPECT_FALSE(rig_with(mounting, *text)) << "which says it already";
  EXPECT_FALSE(rig_with({"base_link", "camera", {0.0, 0.0, 0.9}}, plain)) << "over the axle";
  EXPECT_FALSE(rig_with(mounting, rig_text(rig))) << "which says that it is over the axle";
  EXPECT_FALSE(rig_with(mounting, "no rig"));
}

Eigen::Matrix3d turned(double angle_rad, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix();
}

const std::string kMirror =
    "front_end = \"colour\"\n[camera]\nmodel = \"parabolic_mirror\"\ncentre_px = [320.0, 240.0]\nhorizon_radius_px = "
    "150.0\n";

TEST(CameraMounting, TellsHowAnImageCameraLeans) {
  const CameraTilt tilt{.roll_rad = 0.03, .pitch_rad = -0.02};
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  // Camera frames: x ahead; rotated about the vertical axis; x up.
  for (const Eigen::Matrix3d& frame :
       {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), turned(1.2, z), turned(-kPi / 2.0, y)}) {
    const CameraMounting mounting{"base_link", "camera", {0.0, 0.0, 0.9}, tilt.R_level_camera() * frame};
    const auto text = rig_with(mounting, kMirror);
    ASSERT_TRUE(text);
    const auto read = read_rig(*text, "rig.toml");
    ASSERT_TRUE(read) << azimuth::text(read.error());
    EXPECT_NEAR(read->camera.roll_rad, tilt.roll_rad, 6e-5);
    EXPECT_NEAR(read->camera.pitch_rad, tilt.pitch_rad, 6e-5);
    EXPECT_FALSE(rig_with(mounting, *text)) << "which says it already";
  }
  const CameraMounting level{"base_link", "camera", {0.0, 0.0, 0.9}, turned(0.4, z)};
  EXPECT_FALSE(rig_with(level, kMirror));
  const CameraMounting sideways{"base_link", "camera", {0.0, 0.0, 0.9}, turned(0.8, x)};
  EXPECT_FALSE(rig_with(sideways, kMirror)) << "no axis of it is the optical one for certain";
  const CameraMounting leaning{"base_link", "camera", {0.0, 0.0, 0.9}, turned(0.03, x)};
  EXPECT_FALSE(rig_with(leaning, "[camera]\nmodel = \"bearings\"\n")) << "whose bearings are level";
}

/// The rig applies the tilt first and the yaw second.
TEST(CameraMounting, LeansBeforeItTurns) {
  const CameraTilt tilt{.roll_rad = 0.03, .pitch_rad = -0.02};
  const CameraMounting mounting{
      "base_link", "camera", {0.0, 0.0, 0.9}, turned(1.0, Eigen::Vector3d::UnitZ()) * tilt.R_level_camera()};
  const auto read = read_rig(rig_with(mounting, kMirror + "yaw_offset_rad = 1.0\n").value_or(""), "rig.toml");
  ASSERT_TRUE(read);
  EXPECT_NEAR(read->camera.roll_rad, tilt.roll_rad, 6e-5);
  EXPECT_NEAR(read->camera.pitch_rad, tilt.pitch_rad, 6e-5);
}

}  // namespace
}  // namespace azimuth
