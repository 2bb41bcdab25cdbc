#include "settings/configuration.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "settings/configured_estimator.hpp"
#include "settings/rig.hpp"
#include "settings/section.hpp"
#include "tests/settings/member_count.hpp"

namespace azimuth {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

Configuration read(std::string_view text, const std::vector<std::string>& overrides = {}) {
  const FileResult<Configuration> read = read_configuration(text, "azimuth.toml", overrides);
  EXPECT_TRUE(read) << azimuth::text(read.error());
  return read ? *read : Configuration{};
}

/// The reference with every line `#key = value` activated; other comments stay comments.
std::string uncommented(const std::string& reference) {
  std::string text;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const bool line_start = i == 0 || reference[i - 1] == '\n';
    if (line_start && reference[i] == '#' && i + 1 < reference.size() && reference[i + 1] != ' ') continue;
    text += reference[i];
  }
  return text;
}

TEST(Configuration, EmptyTextIsAllDefaults) {
  const Configuration configuration = read("");
  EXPECT_EQ(configuration.estimator, EstimatorKind::by_rig);
  EXPECT_EQ(configuration.lamp_ekf, LampEkfSettings{});
  EXPECT_EQ(configuration.ekf, EkfSettings{});
}

TEST(Configuration, GivenKeysWin) {
  const Configuration configuration =
      read("[ekf]\nthinning_s = 2\ninitialisation = \"undelayed\"\n[stage]\nwait_for_odometry_s = 0.25\n");
  EkfSettings expected;
  expected.thinning_s = 2;
  expected.initialisation = Initialisation::undelayed;
  EXPECT_EQ(configuration.ekf, expected);
  EXPECT_EQ(configuration.stage.wait_for_odometry_s, 0.25);
}

TEST(Configuration, PresetComesFirstWhereverItStands) {
  EkfSettings expected = paper_preset();
  expected.identity = paper_identity_preset();
  expected.max_landmarks = 500;
  expected.thinning_s = 0.25;
  const Configuration configuration = read("[ekf]\nmax_landmarks = 500\n", {"ekf.thinning_s=0.25", "preset=paper"});
  EXPECT_EQ(configuration.ekf, expected);
}

TEST(Configuration, ItsTextReadsAsItself) {
  for (const std::string_view text : {"", "preset = \"paper\"\n[ekf]\nmax_landmarks = 500\nthinning_s = 0.1\n",
                                      "[ekf]\nmax_viewing_distance_m = 13.123456789012345\ninitialisation = "
                                      "\"undelayed\"\n[stage]\nwait_for_odometry_s = 0.7\n"}) {
    const Configuration configuration = read(text), again = read(configuration_text(configuration));
    EXPECT_EQ(again.ekf, configuration.ekf) << text;
    EXPECT_EQ(again.stage.wait_for_odometry_s, configuration.stage.wait_for_odometry_s);
    EXPECT_EQ(again.estimator, configuration.estimator);
  }
}

TEST(Configuration, AKeyGivenAtItsDefaultStillBeatsThePreset) {
  const double by_default = EkfSettings{}.thinning_s;
  ASSERT_NE(paper_preset().thinning_s, by_default);
  EXPECT_EQ(read(fmt::format("preset = \"paper\"\n[ekf]\nthinning_s = {}\n", by_default)).ekf.thinning_s, by_default);
}

TEST(Configuration, OnePresetIsThatOfBothPapers) {
  SiftSettings sift = paper_sift_preset();
  sift.target_count = 50;
  FastSlamSettings fastslam = paper_fastslam_preset();
  fastslam.particles = 50;
  const Configuration paper = read("preset = \"paper\"\n[sift]\ntarget_count = 50\n[fastslam]\nparticles = 50\n");
  for (const Configuration& configuration : {paper, read(configuration_text(paper))}) {
    EXPECT_EQ(configuration.perception.sift, sift);
    EXPECT_EQ(configuration.ekf.identity, paper_identity_preset());
    EXPECT_EQ(configuration.fastslam, fastslam);
    EXPECT_EQ(configuration.smoother, HindsightSettings{}) << "no paper has it";
  }
  EXPECT_EQ(read("preset = \"paper-7deg\"\n").fastslam, paper_7deg_fastslam_preset());
  EXPECT_EQ(read("preset = \"paper-7deg\"\n").perception.sift, paper_sift_preset());
}

TEST(Configuration, TheRigChoosesTheEstimatorUnlessOneIsNamed) {
  Rig rig;
  const Configuration unsaid = read("");
  for (const bool identities : {true, false}) {
    rig.camera.identities = identities;
    EXPECT_EQ(chosen_estimator(rig, unsaid), EstimatorKind::smoother);
    EXPECT_EQ(chosen_estimator(rig, read("preset = \"paper\"\n")), EstimatorKind::ekf);
    EXPECT_EQ(chosen_estimator(rig, read("[map]\nmode = \"localise\"\n")), EstimatorKind::ekf);
  }
  rig.front_end = FrontEnd::sift;
  rig.camera.model = EquidistantRig{};
  EXPECT_EQ(chosen_estimator(rig, unsaid), EstimatorKind::ekf);
  rig.front_end = FrontEnd::bearings;
  EXPECT_EQ(chosen_estimator(rig, unsaid), EstimatorKind::lamp_ekf);
  rig.front_end = FrontEnd::lamps;
  rig.camera.model = PolynomialRig{};
  EXPECT_EQ(chosen_estimator(rig, unsaid), EstimatorKind::lamp_ekf);
  for (const std::string named : {"ekf", "lamp_ekf", "fastslam", "smoother"})
    EXPECT_EQ(name(chosen_estimator(rig, read("estimator = \"" + named + "\"\n"))), named);
}

TEST(Configuration, OverridesBeatTheFile) {
  EXPECT_EQ(read("[ekf]\nthinning_s = 16\n", {"ekf.thinning_s=4"}).ekf.thinning_s, 4.0);
}

TEST(Configuration, ReportsFileAndOverridesTogether) {
  const std::vector<std::string> overrides{"ekf.max_landmarks=0", "efk.thinning_s=1"};
  const FileResult<Configuration> read =
      read_configuration("estimator = \"magic\"\n[ekf]\nthining_s = 1\n", "a.toml", overrides);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error(), SizeIs(4)) << text(read.error());
  EXPECT_THAT(text(read.error()),
              HasSubstr("a.toml:3:1: unknown key 'thining_s' in [ekf]; did you mean 'thinning_s'?"));
}

TEST(Configuration, LeavesTheDaemonsTablesToTheDaemon) { read("[daemon.lcm]\nurl = \"udpm://\"\n"); }

TEST(Configuration, DefaultsLieInTheirRanges) {
  Configuration configuration;
  for (const Section& section : configuration_sections(configuration)) {
    for (const Key& key : section.keys) {
      EXPECT_FALSE(key.help.empty()) << key.name;
      EXPECT_TRUE(key.in_range()) << key.name << " = " << key.value_text();
    }
  }
}

TEST(Configuration, TablesOfTheRigColoursAndHealthNameEveryMember) {
  Configuration configuration;
  RigKeys rig;
  std::vector<Section> all = configuration_sections(configuration);
  for (Section& section : rig_sections(rig)) all.push_back(std::move(section));
  const auto keys = [&](std::string_view name) {
    const auto section = std::ranges::find(all, name, &Section::name);
    return section == all.end() ? 0U : section->elements ? section->elements->keys(0).size() : section->keys.size();
  };
  EXPECT_EQ(keys("stage"), member_count<StageSettings>());
  EXPECT_EQ(keys("colour.class"), member_count<ColourClass>());
  EXPECT_EQ(keys("health"), member_count<HealthSettings>());
  EXPECT_EQ(keys("camera"), member_count<CameraRig>() - 2 + member_count<ImageRig>() + member_count<ModelKeys>());
  EXPECT_EQ(keys("odometry"), member_count<OdometryRig>());
}

TEST(Configuration, AKeyOfAnEarlierVersionIsIgnoredInAFileAndRefusedOnTheCommandLine) {
  const Configuration old = read(
      "[ekf]\nthinning_s = 2\ngate_chi2 = 16\n[fastslam]\nmax_counter = 3\n"
      "[colour]\narea_min_px2 = 9\n");
  EXPECT_EQ(old.ekf.thinning_s, 2.0);
  EXPECT_EQ(old.ekf.gates.chi2, EkfSettings{}.gates.chi2);
  EXPECT_THAT(old.warnings,
              UnorderedElementsAre("azimuth.toml:3: unknown key 'gate_chi2' in [ekf]; it is a key no more: the "
                                   "value that measured best is built in, and the value is ignored",
                                   HasSubstr("azimuth.toml:5: unknown key 'max_counter' in [fastslam]"),
                                   HasSubstr("azimuth.toml:7: unknown key 'area_min_px2' in [colour]")));
  const FileResult<Configuration> refused =
      read_configuration("", "a.toml", std::vector<std::string>{"ekf.gate_chi2=4"});
  ASSERT_FALSE(refused);
  EXPECT_THAT(text(refused.error()), HasSubstr("unknown key 'gate_chi2' in [ekf]; it is a key no more"));
}

/// Defaults that no paper describes must not affect the presets that reproduce the papers.
TEST(Configuration, PaperPresetsKeepNothingOfOurs) {
  const IdentitySettings identity = paper_identity_preset();
  EXPECT_EQ(identity.view_spacing_m, 0.0);
  EXPECT_EQ(identity.stable_sightings, 1) << "nothing is forgotten";
  EXPECT_EQ(identity.independent_bearings, 0);
  for (const FastSlamSettings& fastslam : {paper_fastslam_preset(), paper_7deg_fastslam_preset()}) {
    EXPECT_EQ(fastslam.key_distance_m, 0.0);
    EXPECT_FALSE(fastslam.refute_landmarks);
  }
}

TEST(Configuration, PaperPresetLiesInTheRanges) {
  Configuration configuration;
  configuration.ekf = paper_preset();
  configuration.ekf.identity = paper_identity_preset();
  configuration.perception.sift = paper_sift_preset();
  configuration.fastslam = paper_fastslam_preset();
  std::vector<Section> sections = configuration_sections(configuration);
  const std::vector<Section*> tables = pointers(sections);
  EXPECT_TRUE(read_configuration(uncommented(reference(tables)), "reference"));
}

TEST(Reference, NamesEveryKeyOnceAndReadsBackAsTheDefaults) {
  Configuration configuration;
  std::vector<Section> sections = configuration_sections(configuration);
  for (Section& section : sections) {
    const std::string text = reference(std::array{&section});
    for (const Key& key : section.keys) {
      const std::string line = "\n#" + std::string(key.name) + " = ";
      EXPECT_EQ(text.find(line), text.rfind(line)) << key.name;
      EXPECT_THAT(text, HasSubstr(line));
    }
  }
  const Configuration again = read(uncommented(reference(pointers(sections))));
  EXPECT_EQ(again.ekf, EkfSettings{});
  EXPECT_EQ(again.perception.sift, SiftSettings{});
  EXPECT_EQ(again.fastslam, FastSlamSettings{});
  EXPECT_EQ(again.lamp_ekf, LampEkfSettings{});
  EXPECT_EQ(again.perception.colour, ColourSettings{});
  EXPECT_EQ(again.perception.lamps, LampSettings{});
}

/// Each help text must be understandable alone, because lists show it without the keys around it.
TEST(Reference, HelpsCanBeUnderstoodAlone) {
  Configuration configuration;
  RigKeys rig;
  std::vector<Section> all = configuration_sections(configuration);
  for (Section& section : rig_sections(rig)) all.push_back(std::move(section));
  for (const Section& section : all)
    for (const Key& key : section.elements ? section.elements->keys(0) : section.keys)
      for (const std::string_view leaning : {"Likewise", "And ", "Its ", "Their ", "Of ", "See ", "than ", "It "})
        EXPECT_FALSE(key.help.starts_with(leaning)) << section.name << "." << key.name << ": " << key.help;
}

TEST(Configuration, AKeyThatMovedIsNamedWithItsNewPlace) {
  const FileResult<Configuration> old = read_configuration(
      "[ekf]\nlost_sigma_m = 3.0\nrelocalise = false\npreset = \"paper\"\n[fastslam]\ndegraded_after_m = "
      "2\n[smoother]\n"
      "calibrate_turn = false\n",
      "a.toml");
  ASSERT_FALSE(old);
  const std::string violations = text(old.error());
  EXPECT_THAT(violations, HasSubstr("a.toml:2:1: unknown key 'lost_sigma_m' in [ekf]; it belongs in [health]"));
  EXPECT_THAT(violations,
              HasSubstr("a.toml:3:1: unknown key 'relocalise' in [ekf]; it is relocalisation.lost_log_odds"));
  EXPECT_THAT(violations, HasSubstr("'preset' in [ekf]; it is preset, at the top of the file now"));
  EXPECT_THAT(violations, HasSubstr("'calibrate_turn' in [smoother]; it is odometry.sigma_scale_turn"));
  EXPECT_THAT(violations,
              HasSubstr("a.toml:6:1: unknown key 'degraded_after_m' in [fastslam]; it belongs in [health]"));
}

TEST(Reference, OfTheRigReadsBack) {
  RigKeys rig;
  std::vector<Section> sections = rig_sections(rig);
  const FileResult<Rig> again = read_rig(uncommented(reference(pointers(sections))), "reference");
  EXPECT_TRUE(again) << text(again.error());
}

}  // namespace
}  // namespace azimuth
