// Every file below config/ is what it says it is.

#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "daemon/config/daemon_settings.hpp"
#include "settings/configuration.hpp"
#include "settings/rig.hpp"
#include "slam/perception/make_perception.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

const fs::path kConfig = AZIMUTH_SOURCE_DIR "/config";

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

/// Of a file that has to be right, rig and all.
Settings read(const fs::path& file) {
  Settings settings;
  std::vector<Section> sections = daemon_sections(settings.daemon);
  const Outcome<Configuration> read = read_configuration_file(file, {}, pointers(sections));
  EXPECT_TRUE(read) << text(read.violations());
  if (read) settings.configuration = *read;
  if (settings.daemon.rig.empty()) settings.daemon.rig = "given on the command line";
  EXPECT_TRUE(check(settings.daemon).empty()) << file << '\n' << text(check(settings.daemon));
  return settings;
}

Rig read_rig_of(const std::string& front_end) {
  const Outcome<Rig> rig = read_rig_file(kConfig / "rigs" / (front_end + ".toml"));
  EXPECT_TRUE(rig) << text(rig.violations());
  return rig ? *rig : Rig{};
}

TEST(ShippedConfigurations, AreAllValid) {
  const std::vector<fs::path> files = toml_files(kConfig);
  EXPECT_GE(files.size(), 6U);
  for (const fs::path& file : files) read(file);
}

TEST(ShippedConfigurations, RigsAreAllValidAndNameAFrontEndThatExists) {
  const std::vector<fs::path> files = toml_files(kConfig / "rigs");
  EXPECT_GE(files.size(), 2U);
  for (const fs::path& file : files) {
    const Outcome<Rig> rig = read_rig_file(file);
    ASSERT_TRUE(rig) << text(rig.violations());
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

TEST(ShippedConfigurations, PaperFilesSayWhatThePaperSays) {
  const double sigma_rad = read_rig_of("colour-mirror").camera.sigma_bearing_rad;
  EkfSettings paper = paper_preset(sigma_rad);
  EXPECT_EQ(ekf_settings(read(kConfig / "paper-colour.toml").configuration, sigma_rad), paper);
  paper.identity = paper_identity_preset();
  EXPECT_EQ(ekf_settings(read(kConfig / "paper-sift.toml").configuration, sigma_rad), paper);
}

}  // namespace
}  // namespace azimuth
