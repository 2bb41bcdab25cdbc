#include "settings/rig.hpp"

#include <filesystem>
#include <gmock/gmock.h>
#include <map>

#include "slam/camera/camera_rig.hpp"
#include "slam/camera/make_camera.hpp"
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
  const FileResult<Rig> rig = read_rig(kMirror, "rig.toml");
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(rig->front_end, FrontEnd::sift);
  ASSERT_EQ(name(rig->camera.model), "hyperbolic_mirror");
  EXPECT_EQ(rig->camera.image.width_px, 1024);
  EXPECT_EQ(rig->camera.image.centre_px, (PixelPoint{512.0, 384.0}));
  EXPECT_EQ(std::get<HyperbolicMirrorRig>(rig->camera.model).b_mm, 23.4125);
  EXPECT_EQ(rig->camera.image.theta_max_rad, std::nullopt);
  EXPECT_EQ(rig->odometry.lambda_distance_m, 9e-4);
  EXPECT_EQ(rig->odometry.scale_turn, OdometryRig{}.scale_turn);
}

TEST(RigFile, AsksForWhatTheModelNeeds) {
  const FileResult<Rig> rig = read_rig("[camera]\nmodel = \"pajdla\"\na_px = 1\nb = 1\nc_px = 1\n", "rig.toml");
  ASSERT_FALSE(rig);
  EXPECT_THAT(text(rig.error()), HasSubstr("camera model \"pajdla\" needs the key 'centre_px' in [camera]"));
  EXPECT_THAT(rig.error(), SizeIs(3)) << text(rig.error());
}

TEST(RigFile, ChecksKeysAgainstEachOther) {
  const FileResult<Rig> rig =
      read_rig("[camera]\nazimuth_direction = 0\nmask_inner_px = 5\nmask_outer_px = 4\n", "rig.toml");
  ASSERT_FALSE(rig);
  EXPECT_THAT(rig.error(), SizeIs(2)) << text(rig.error());
}

/// A camera of each model, with valid parameters.
std::string camera_text(std::string_view model) {
  return "[camera]\nmodel = \"" + std::string(model) + R"("
centre_px = [320.25, 240]
focal_length_px = 120.5
theta_max_rad = 1.5
horizon_radius_px = 285.403
mirror_a_mm = 28.095
mirror_b_mm = 23.4125
a_px = 11920.0
b = 100
c_px = 11920.0
d = 100
polynomial_a0 = -300.5
polynomial_a2 = 1e-3
polynomial_a3 = 0
polynomial_a4 = 1e-9
)";
}

class RigModel : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Each, RigModel,
                         testing::Values("hyperbolic_mirror", "parabolic_mirror", "pajdla", "equidistant",
                                         "polynomial"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(RigModel, GivesACamera) {
  const FileResult<Rig> rig = read_rig(camera_text(GetParam()), "rig.toml");
  ASSERT_TRUE(rig) << text(rig.error());
  std::string problem;
  const std::optional<CameraModel> camera = camera_of(rig->camera, problem);
  ASSERT_TRUE(camera) << problem;
  const Pixel pixel{400.0, 180.0};
  const std::optional<Direction> direction = camera->direction(pixel);
  ASSERT_TRUE(direction);
  EXPECT_NEAR(direction->azimuth_rad, axes_of(rig->camera.image).azimuth_rad(pixel), 1e-12);
}

TEST_P(RigModel, NeedsMoreThanItsName) {
  const FileResult<Rig> rig = read_rig("[camera]\nmodel = \"" + std::string(GetParam()) + "\"\n", "rig.toml");
  ASSERT_FALSE(rig);
  EXPECT_THAT(text(rig.error()), HasSubstr("needs the key 'centre_px' in [camera]"));
}

/// Each model requires exactly its own parameters. The polynomial model has one optional parameter, which is usually 0.
TEST(RigFile, AsksForTheParametersOfItsModelOnly) {
  const std::map<std::string_view, std::vector<std::string_view>> needed{
      {"bearings", {}},
      {"radial", {"centre_px"}},
      {"hyperbolic_mirror", {"centre_px", "mirror_a_mm", "mirror_b_mm", "focal_length_px"}},
      {"parabolic_mirror", {"centre_px", "horizon_radius_px"}},
      {"pajdla", {"centre_px", "a_px", "b", "c_px", "d", "theta_max_rad"}},
      {"equidistant", {"centre_px", "focal_length_px", "theta_max_rad"}},
      {"polynomial",
       {"centre_px", "polynomial_a0", "polynomial_a2", "polynomial_a3", "polynomial_a4", "theta_max_rad"}}};
  EXPECT_EQ(needed.size(), all_models().size());
  for (const auto& [model, keys] : needed) {
    const FileResult<Rig> rig = read_rig("[camera]\nmodel = \"" + std::string(model) + "\"\n", "rig.toml");
    std::string expected;
    for (const std::string_view key : keys)
      expected += "rig.toml: camera model \"" + std::string(model) + "\" needs the key '" + std::string(key) +
                  "' in [camera]\n";
    EXPECT_EQ(rig ? "" : text(rig.error()), expected);
  }
}

TEST(RigFile, NeedsOnlyACentreForAzimuthsAlone) {
  const FileResult<Rig> rig = read_rig("[camera]\nmodel = \"radial\"\ncentre_px = [10, 20]\n", "rig.toml");
  ASSERT_TRUE(rig) << text(rig.error());
  std::string problem;
  EXPECT_FALSE(camera_of(rig->camera, problem)) << "nothing is known of elevations";
  EXPECT_FALSE(read_rig("[camera]\nmodel = \"radial\"\n", "rig.toml"));
}

/// A tilt cannot be corrected for bearings from an external detector, or if the camera model has no elevations.
TEST(RigFile, RefusesATiltThatLevelsNothing) {
  const auto problem = [](const std::string& camera) {
    const FileResult<Rig> rig = read_rig("[camera]\n" + camera, "rig.toml");
    return rig ? "" : text(rig.error());
  };
  EXPECT_THAT(problem("model = \"bearings\"\nroll_rad = 0.02\n"), HasSubstr("come ready made are level"));
  const std::string radial = "model = \"radial\"\ncentre_px = [10, 20]\n";
  for (const char* const key : {"roll_rad", "pitch_rad", "sigma_tilt_rad"})
    EXPECT_THAT(problem(radial + key + " = 0.02\n"), HasSubstr("model \"radial\" does not"));
  EXPECT_EQ(problem(radial + "roll_rad = 0.0\n"), "");
  const std::string mirror = "model = \"parabolic_mirror\"\ncentre_px = [10, 20]\nhorizon_radius_px = 150.0\n";
  EXPECT_EQ(problem(mirror + "roll_rad = 0.02\npitch_rad = -0.01\nsigma_tilt_rad = 0.01\n"), "");
  EXPECT_THAT(problem(mirror + "roll_rad = 1.0\n"), HasSubstr("'camera.roll_rad'"));
}

/// A rig without a tilt does not state that the camera is level. Writing the rig keeps the tilt unstated.
TEST(RigFile, LeavesATiltUnknownWhereElevationsAreKnown) {
  const auto unknown_rad = [](const std::string& camera) {
    const FileResult<Rig> rig = read_rig("[camera]\n" + camera, "rig.toml");
    const FileResult<Rig> again = read_rig(rig_text(*rig), "rig.toml");
    EXPECT_TRUE(again);
    EXPECT_EQ(again->camera.sigma_tilt_rad, rig->camera.sigma_tilt_rad);
    return sigma_tilt_rad(rig->camera);
  };
  const std::string mirror = "model = \"parabolic_mirror\"\ncentre_px = [10, 20]\nhorizon_radius_px = 150.0\n";
  EXPECT_EQ(unknown_rad(mirror), 0.02);
  EXPECT_EQ(unknown_rad(mirror + "sigma_tilt_rad = 0.0\n"), 0.0);
  EXPECT_EQ(unknown_rad("model = \"radial\"\ncentre_px = [10, 20]\n"), 0.0);
  EXPECT_EQ(unknown_rad("model = \"bearings\"\n"), 0.0);
}

TEST(RigFile, HidesPolygons) {
  const FileResult<Rig> rig = read_rig(
      "[camera]\ncentre_px = [0, 0]\nmask_polygons_px = [\n  [[0, 0], [10, 0], [0, 10.5]],\n  [[20, 20], [30, 20], "
      "[30, 30], [20, 30]]]\n",
      "rig.toml");
  ASSERT_TRUE(rig) << text(rig.error());
  ASSERT_THAT(rig->camera.image.mask_polygons_px, SizeIs(2));
  EXPECT_EQ(rig->camera.image.mask_polygons_px[0][2], (PixelPoint{0.0, 10.5}));
  const ImageMask mask(axes_of(rig->camera.image), mask_of(rig->camera.image));
  EXPECT_FALSE(mask.visible({2.0, 2.0}));
  EXPECT_FALSE(mask.visible({25.0, 25.0}));
  EXPECT_TRUE(mask.visible({15.0, 15.0}));
}

TEST(RigFile, NamesTheCornerThatIsWrong) {
  const auto complaint = [](const std::string& value) {
    const FileResult<Rig> rig = read_rig("[camera]\nmask_polygons_px = " + value + "\n", "rig.toml");
    return rig ? std::string("none") : text(rig.error());
  };
  EXPECT_EQ(complaint("[]"), "none");
  EXPECT_THAT(complaint("7"), HasSubstr("rig.toml:2:1: 'camera.mask_polygons_px' must be a list of polygons"));
  EXPECT_THAT(complaint("[7]"), HasSubstr("polygon 1 must be a list of corners, not a whole number"));
  EXPECT_THAT(complaint("[[[1, 2], [3, 4]]]"), HasSubstr("polygon 1 has 2 corners, needs at least 3"));
  EXPECT_THAT(complaint("[[[1, 2], [3, 4], [5, 6]], [[1, 2], [3], [5, 6]]]"),
              HasSubstr("polygon 2 corner 2 must be a pair of numbers [a, b], not an array"));
  EXPECT_THAT(complaint("[[[1, 2], [3, 4], [5, 1e9]]]"), HasSubstr("polygon 1 corner 3 is 1000000000"));
  EXPECT_THAT(complaint("[[[1, 2], [3, 4], [5, nan]]]"), HasSubstr("corner 3 must be finite"));
}

TEST(RigFile, ComesBackFromItsText) {
  for (const char* model : {"hyperbolic_mirror", "parabolic_mirror", "pajdla", "equidistant", "polynomial"}) {
    Rig rig = *read_rig(camera_text(model), "rig.toml");
    rig.front_end = FrontEnd::colour;
    rig.camera.image.mask_polygons_px = {{{1.0, 2.0}, {3.5, -4.0}, {5.0, 6.0}}, {{0.1, 0.2}, {7.0, 8.0}, {9.0, 1.0}}};
    rig.camera.image.azimuth_offset_rad = -1.0 / 3.0;
    rig.odometry.lambda_distance_m = 1.0 / 7.0;
    const std::string written = rig_text(rig);
    const FileResult<Rig> read = read_rig(written, "rig.toml");
    ASSERT_TRUE(read) << text(read.error()) << written;
    EXPECT_EQ(rig_text(*read), written);
    EXPECT_EQ(name(read->camera.model), model);
    EXPECT_TRUE(read->camera.model == rig.camera.model);
    EXPECT_EQ(read->camera.image.mask_polygons_px, rig.camera.image.mask_polygons_px);
    EXPECT_EQ(read->camera.image.azimuth_offset_rad, rig.camera.image.azimuth_offset_rad);
    EXPECT_EQ(read->odometry.lambda_distance_m, rig.odometry.lambda_distance_m);
    EXPECT_EQ(read->camera.image.width_px, std::nullopt);
  }
}

TEST(RigFile, HintsAtTheUnitOfTheBearingNoise) {
  const FileResult<Rig> rig = read_rig("[camera]\nsigma_bearing_deg = 2.5\n", "rig.toml");
  ASSERT_FALSE(rig);
  EXPECT_THAT(text(rig.error()), HasSubstr("rig.toml:2:1: unknown key 'sigma_bearing_deg' in [camera]; the key is "
                                           "'sigma_bearing_rad', in rad: 2.5 deg is 0.0436332 rad"));
}

TEST(RigFile, NamesAFileThatCannotBeRead) {
  const FileResult<Rig> rig = read_rig_file("no/such/rig.toml");
  ASSERT_FALSE(rig);
  EXPECT_EQ(text(rig.error()), "no/such/rig.toml: cannot be read: No such file or directory\n");
}

TEST(RigFile, DefaultsLieInTheirRanges) {
  RigKeys rig;
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
    const FileResult<Rig> rig = read_rig_file(entry.path());
    EXPECT_TRUE(rig) << text(rig.error());
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace azimuth
