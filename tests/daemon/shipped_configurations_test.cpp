// Every file below config/ is valid and does what its name says.

#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "daemon/config/daemon_settings.hpp"
#include "drivers/can/can_layout.hpp"
#include "settings/configuration.hpp"
#include "settings/file_text.hpp"
#include "settings/retired_keys.hpp"
#include "settings/rig.hpp"
#include "slam/camera/make_camera.hpp"
#include "slam/perception/make_perception.hpp"
#include "tests/support/places.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

const fs::path kConfig = test::source_folder() / "config";

std::vector<fs::path> toml_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  return files;
}

struct Settings {
  Configuration configuration;
  DaemonSettings daemon;
};

/// Reads a configuration file that must be valid together with its daemon settings.
Settings read(const fs::path& file) {
  Settings settings;
  std::vector<Section> sections = daemon_sections(settings.daemon);
  const FileResult<Configuration> read = read_configuration_file(file, {}, pointers(sections));
  EXPECT_TRUE(read) << text(read.error());
  if (read) settings.configuration = *read;
  if (settings.daemon.rig.empty()) settings.daemon.rig = "given on the command line";
  EXPECT_TRUE(check(settings.daemon).empty()) << file << '\n' << text(check(settings.daemon));
  return settings;
}

Rig read_rig_of(const std::string& front_end) {
  const FileResult<Rig> rig = read_rig_file(kConfig / "rigs" / (front_end + ".toml"));
  EXPECT_TRUE(rig) << text(rig.error());
  return rig ? *rig : Rig{};
}

TEST(ShippedConfigurations, AreAllValid) {
  const std::vector<fs::path> files = toml_files(kConfig);
  EXPECT_GE(files.size(), 9U);
  for (const fs::path& file : files) read(file);
}

TEST(ShippedConfigurations, RigsAreAllValidAndNameAFrontEndThatExists) {
  const std::vector<fs::path> files = toml_files(kConfig / "rigs");
  EXPECT_GE(files.size(), 3U);
  for (const fs::path& file : files) {
    const FileResult<Rig> rig = read_rig_file(file);
    ASSERT_TRUE(rig) << text(rig.error());
    EXPECT_NE(make_perception(rig->front_end, rig->camera, {}), nullptr) << file;
  }
}

TEST(ShippedConfigurations, MirrorsHaveTheRigOfTheirFrontEnd) {
  EXPECT_EQ(read_rig_of("colour-mirror").front_end, FrontEnd::colour);
  EXPECT_EQ(read_rig_of("sift-mirror").front_end, FrontEnd::sift);
  for (const char* const name : {"colour-mirror.toml", "sift-mirror.toml"}) {
    const LiveSettings live = read(kConfig / name).daemon.live;
    EXPECT_EQ(live.odometer, OdometerKind::pioneer);
    EXPECT_EQ(live.camera, CameraKind::shared);
  }
}

TEST(ShippedConfigurations, TheCanBaseFindsItsSignals) {
  const LiveSettings live = read(kConfig / "can-robot.toml").daemon.live;
  EXPECT_EQ(live.odometer, OdometerKind::can);
  EXPECT_EQ(live.can.dbc, (kConfig / "simulated-can.dbc").string()) << "beside it, wherever both are put";
  const FileResult<std::string> dbc_text = file_text(live.can.dbc);
  ASSERT_TRUE(dbc_text);
  const FileResult<Dbc> dbc = read_dbc(*dbc_text, live.can.dbc);
  ASSERT_TRUE(dbc) << text(dbc.error());
  const FileResult<CanLayout> layout = find_can_layout(live.can, &*dbc);
  ASSERT_TRUE(layout) << text(layout.error());
  EXPECT_TRUE(layout->battery && layout->emergency_stop && layout->bumper && layout->charging);
}

TEST(ShippedConfigurations, PaperFilesSayWhatThePaperSays) {
  EkfSettings paper = paper_preset();
  paper.identity = paper_identity_preset();
  EXPECT_EQ(read(kConfig / "paper-colour.toml").configuration.ekf, paper);
  EXPECT_EQ(read(kConfig / "paper-sift.toml").configuration.ekf, paper);
}

TEST(ShippedConfigurations, CeilingCamerasRunEitherEstimatorOfLamps) {
  const Settings fastslam = read(kConfig / "ceiling-fastslam.toml"), ekf = read(kConfig / "ceiling-lamps.toml");
  EXPECT_EQ(fastslam.configuration.estimator, EstimatorKind::fastslam);
  EXPECT_EQ(fastslam.configuration.fastslam, FastSlamSettings{});
  EXPECT_EQ(ekf.configuration.estimator, EstimatorKind::lamp_ekf);
  EXPECT_EQ(ekf.configuration.lamp_ekf, LampEkfSettings{});
  for (const Settings* const ceiling : {&fastslam, &ekf}) EXPECT_EQ(ceiling->daemon.live.camera, CameraKind::shared);
  const Rig rig = read_rig_of("ceiling-fisheye");
  EXPECT_EQ(rig.front_end, FrontEnd::lamps);
  EXPECT_GT(rig.camera.image.viewpoint_height_m, 0.0) << "heights in the map would be above the camera";
}

/// With the heading up in the image, an upward-looking camera shows the robot's left on the right.
TEST(ShippedConfigurations, TheCeilingCamerasImageIsNotFlipped) {
  std::string problem;
  const std::optional<CameraModel> camera = camera_of(read_rig_of("ceiling-fisheye").camera, problem);
  ASSERT_TRUE(camera) << problem;
  EXPECT_LT(camera->pixel(Eigen::Vector3d(1.0, 0.0, 2.0))->y(), 300.0);  // a point ahead lies above the middle at 383.5
  // a point to the left lies to the right of 511.5
  EXPECT_GT(camera->pixel(Eigen::Vector3d(0.0, 1.0, 2.0))->x(), 600.0);
}

TEST(ShippedConfigurations, PaperLampFilesSayWhatThePaperSays) {
  const auto settings_in = [](const char* name) { return read(kConfig / name).configuration; };
  EXPECT_EQ(settings_in("paper-lamps.toml").estimator, EstimatorKind::fastslam);
  EXPECT_EQ(settings_in("paper-lamps.toml").fastslam, paper_fastslam_preset());
  EXPECT_EQ(settings_in("paper-lamps-7deg.toml").estimator, EstimatorKind::fastslam);
  EXPECT_EQ(settings_in("paper-lamps-7deg.toml").fastslam, paper_7deg_fastslam_preset());
}

/// The number of keys stays small enough for a user to read all of them. Settings for developers only are members of
/// their structs.
TEST(ShippedConfigurations, HasNoMoreKeysThanAnOwnerReads) {
  Configuration configuration;
  DaemonSettings daemon;
  std::vector<Section> all = configuration_sections(configuration);
  for (Section& section : daemon_sections(daemon)) all.push_back(std::move(section));
  std::size_t count = 11;  // keys of a signal in daemon.can.signal, which has no signal by default
  for (const Section& section : all)
    count += !section.elements               ? section.keys.size()
             : section.elements->count() > 0 ? section.elements->keys(0).size()
                                             : 0;
  EXPECT_LE(count, 150U);
}

TEST(ShippedConfigurations, NoKeyOfTodayIsRetired) {
  Configuration configuration;
  DaemonSettings daemon;
  std::vector<Section> all = configuration_sections(configuration);
  for (Section& section : daemon_sections(daemon)) all.push_back(std::move(section));
  for (const Section& section : all)
    for (const Key& key : section.keys) EXPECT_FALSE(is_retired(section.name, key.name)) << section.name << key.name;
}

}  // namespace
}  // namespace azimuth
