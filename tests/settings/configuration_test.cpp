#include "settings/configuration.hpp"

#include <algorithm>
#include <array>
#include <gmock/gmock.h>

#include "settings/configured_estimator.hpp"
#include "settings/reference.hpp"
#include "settings/rig.hpp"
#include "tests/settings/member_count.hpp"

namespace azimuth {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

Configuration read(std::string_view text, const std::vector<std::string>& overrides = {}) {
  const FileResult<Configuration> read = read_configuration(text, "azimuth.toml", overrides);
  EXPECT_TRUE(read) << azimuth::text(read.error());
  return read ? *read : Configuration{};
}

/// The reference with every `#key = value` made a key; what is commented out otherwise stays so.
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
  EXPECT_EQ(configuration.estimator, "by_rig");
  EXPECT_EQ(configuration.lamp_ekf, LampEkfSettings{});
  EXPECT_EQ(configuration.ekf, EkfSettings{});
}

TEST(Configuration, GivenKeysWin) {
  const Configuration configuration =
      read("[ekf]\ngate_chi2 = 16\ninitialisation = \"undelayed\"\n[stage]\nwait_for_odometry_s = 0.25\n");
  EkfSettings expected;
  expected.gates.chi2 = 16;
  expected.initialisation = Initialisation::undelayed;
  EXPECT_EQ(configuration.ekf, expected);
  EXPECT_EQ(configuration.stage.wait_for_odometry_s, 0.25);
}

TEST(Configuration, PresetComesFirstWhereverItStands) {
  EkfSettings expected = paper_preset();
  expected.delayed.kl_samples = 500;
  expected.delayed.best_pair = true;
  const Configuration configuration = read("[ekf]\nkl_samples = 500\npreset = \"paper\"\n", {"ekf.best_pair=true"});
  EXPECT_EQ(configuration.ekf, expected);
}

TEST(Configuration, ItsTextReadsAsItself) {
  for (const std::string_view text : {"", "[ekf]\npreset = \"paper\"\nkl_samples = 500\ngate_chi2 = 0.1\n",
                                      "[ekf]\ngate_chi2 = 13.123456789012345\ninitialisation = "
                                      "\"undelayed\"\n[stage]\nwait_for_odometry_s = 0.7\n"}) {
    const Configuration configuration = read(text), again = read(configuration_text(configuration));
    EXPECT_EQ(again.ekf, configuration.ekf) << text;
    EXPECT_EQ(again.stage.wait_for_odometry_s, configuration.stage.wait_for_odometry_s);
    EXPECT_EQ(again.estimator, configuration.estimator);
  }
}

TEST(Configuration, AKeyGivenAtItsDefaultStillBeatsThePreset) {
  const Configuration configuration = read("[ekf]\npreset = \"paper\"\ngate_chi2 = 9.0\n");
  EXPECT_EQ(configuration.ekf.gates.chi2, 9.0);
}

TEST(Configuration, SiftHasAPresetOfItsOwn) {
  SiftSettings expected = paper_sift_preset();
  expected.target_count = 50;
  const Configuration configuration = read("[sift]\ntarget_count = 50\npreset = \"paper\"\n[ekf]\ngate_chi2 = 16\n");
  EXPECT_EQ(configuration.perception.sift, expected);
  EXPECT_EQ(read(configuration_text(configuration)).perception.sift, expected);
  EXPECT_EQ(read("[ekf]\npreset = \"paper\"\n").perception.sift, SiftSettings{}) << "the filter's is not its own";
}

TEST(Configuration, IdentityHasAPresetOfItsOwn) {
  IdentitySettings expected = paper_identity_preset();
  expected.max_ratio = 0.7;
  const Configuration configuration = read("[identity]\nmax_ratio = 0.7\npreset = \"paper\"\n[ekf]\ngate_chi2 = 16\n");
  EXPECT_EQ(configuration.ekf.identity, expected);
  EXPECT_EQ(read(configuration_text(configuration)).ekf.identity, expected);
  EXPECT_EQ(read("[ekf]\npreset = \"paper\"\n").ekf.identity, IdentitySettings{});
}

TEST(Configuration, FastSlamHasPresetsOfItsOwn) {
  FastSlamSettings expected = paper_7deg_fastslam_preset();
  expected.particles = 50;
  const Configuration configuration =
      read("estimator = \"fastslam\"\n[fastslam]\npreset = \"paper-7deg\"\nparticles = 50\n");
  EXPECT_EQ(configuration.estimator, "fastslam");
  EXPECT_EQ(configuration.fastslam, expected);
  EXPECT_EQ(read(configuration_text(configuration)).fastslam, expected);
  EXPECT_EQ(read("[fastslam]\npreset = \"paper\"\n").fastslam, paper_fastslam_preset());
  EXPECT_EQ(read("[ekf]\npreset = \"paper\"\n").fastslam, FastSlamSettings{});
}

TEST(Configuration, TheRigChoosesTheEstimatorUnlessOneIsNamed) {
  Rig rig;
  const Configuration unsaid = read("");
  for (const bool identities : {true, false}) {
    rig.camera.identities = identities;
    EXPECT_EQ(estimator_name(rig, unsaid), "smoother");
    EXPECT_EQ(estimator_name(rig, read("[ekf]\npreset = \"paper\"\n")), "ekf");
    EXPECT_EQ(estimator_name(rig, read("[map]\nmode = \"localise\"\n")), "ekf");
  }
  rig.front_end = FrontEnd::sift;
  rig.camera.model = EquidistantRig{};
  EXPECT_EQ(estimator_name(rig, unsaid), "ekf");
  rig.front_end = FrontEnd::bearings;
  EXPECT_EQ(estimator_name(rig, unsaid), "lamp_ekf");
  rig.front_end = FrontEnd::lamps;
  rig.camera.model = PolynomialRig{};
  EXPECT_EQ(estimator_name(rig, unsaid), "lamp_ekf");
  for (const std::string name : {"ekf", "lamp_ekf", "fastslam", "smoother"})
    EXPECT_EQ(estimator_name(rig, read("estimator = \"" + name + "\"\n")), name);
}

TEST(Configuration, OverridesBeatTheFile) {
  EXPECT_EQ(read("[ekf]\ngate_chi2 = 16\n", {"ekf.gate_chi2=4"}).ekf.gates.chi2, 4.0);
}

TEST(Configuration, ReportsFileAndOverridesTogether) {
  const std::vector<std::string> overrides{"ekf.max_clones=1", "efk.gate_chi2=1"};
  const FileResult<Configuration> read =
      read_configuration("estimator = \"magic\"\n[ekf]\ngate_chi = 1\n", "a.toml", overrides);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error(), SizeIs(4)) << text(read.error());
  EXPECT_THAT(text(read.error()), HasSubstr("a.toml:3:1: unknown key 'gate_chi' in [ekf]; did you mean 'gate_chi2'?"));
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

TEST(Configuration, TablesNameEveryMember) {
  Configuration configuration;
  RigKeys rig;
  std::vector<Section> all = configuration_sections(configuration);
  for (Section& section : rig_sections(rig)) all.push_back(std::move(section));
  const auto keys = [&](std::string_view name) {
    const auto section = std::ranges::find(all, name, &Section::name);
    return section == all.end() ? 0U : section->elements ? section->elements->keys(0).size() : section->keys.size();
  };
  constexpr std::size_t kOfEkf =
      member_count_with_groups<EkfSettings, BearingGateSettings, UnnamedBearingSettings, DelayedSettings,
                               UndelayedSettings, ProbationSettings, MergingSettings, EkfUpdateSettings,
                               CameraYawSettings, CentreSettings, RelocationSettings>();
  EXPECT_EQ(keys("ekf"), kOfEkf + 1 - 3) << "the preset; not identity, relocalisation, health";
  EXPECT_EQ(keys("stage"), member_count<StageSettings>());
  EXPECT_EQ(keys("sift"), member_count<SiftSettings>() + 1) << "and the preset";
  EXPECT_EQ(keys("identity"), member_count<IdentitySettings>() + 1) << "and the preset";
  EXPECT_EQ(keys("colour"), member_count<ColourSettings>() - 1) << "but the classes";
  EXPECT_EQ(keys("colour.class"), member_count<ColourClass>());
  EXPECT_EQ(keys("lamps"), member_count<LampSettings>());
  constexpr std::size_t kOfLampEkf =
      member_count_with_groups<LampEkfSettings, LampsInView, LampGateSettings, LampHeightSettings,
                               LampProbationSettings, LampEvidenceSettings, LampMergingSettings, CentreSettings>();
  EXPECT_EQ(keys("lamp_ekf"), kOfLampEkf - 1) << "but health";
  constexpr std::size_t kOfFastSlam =
      member_count_with_groups<FastSlamSettings, LampsInView, LampAssociationSettings, ParticleWeightSettings,
                               LampCandidateSettings, NewLampSettings>();
  EXPECT_EQ(keys("fastslam"), kOfFastSlam + 1) << "and the preset";
  EXPECT_EQ(keys("health"), member_count<HealthSettings>());
  EXPECT_EQ(keys("relocalisation"), member_count<RelocalisationSettings>());
  EXPECT_EQ(keys("camera"), member_count<CameraRig>() - 2 + member_count<ImageRig>() + member_count<ModelKeys>());
  EXPECT_EQ(keys("odometry"), member_count<OdometryRig>());
}

/// What measured best and no paper has is not in what is compared with it.
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

/// A help is read in a list that leaves out the keys around it.
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

TEST(Reference, LeavesOutWhatIsForExperts) {
  Configuration configuration;
  std::vector<Section> sections = configuration_sections(configuration);
  const std::string everyday = reference(pointers(sections), Tier::everyday), all = reference(pointers(sections));
  EXPECT_THAT(everyday, HasSubstr("#lost_sigma_m = 0"));
  EXPECT_THAT(everyday, Not(HasSubstr("#gate_chi2")));
  EXPECT_THAT(everyday, Not(HasSubstr("[relocalisation]")));
  EXPECT_THAT(all, HasSubstr("# (expert) Gate on one bearing's"));
  EXPECT_LT(everyday.size(), all.size() / 3);
}

TEST(Configuration, AKeyThatMovedIsNamedWithItsNewPlace) {
  const FileResult<Configuration> old = read_configuration(
      "[ekf]\nlost_sigma_m = 3.0\nrelocalise = false\n[fastslam]\ndegraded_after_m = 2\n[smoother]\n"
      "calibrate_turn = false\n",
      "a.toml");
  ASSERT_FALSE(old);
  const std::string violations = text(old.error());
  EXPECT_THAT(violations, HasSubstr("a.toml:2:1: unknown key 'lost_sigma_m' in [ekf]; it belongs in [health]"));
  EXPECT_THAT(violations,
              HasSubstr("a.toml:3:1: unknown key 'relocalise' in [ekf]; it is relocalisation.lost_log_odds"));
  EXPECT_THAT(violations, HasSubstr("'calibrate_turn' in [smoother]; it is odometry.sigma_scale_turn"));
  EXPECT_THAT(violations,
              HasSubstr("a.toml:5:1: unknown key 'degraded_after_m' in [fastslam]; it belongs in [health]"));
}

TEST(Reference, OfTheRigReadsBack) {
  RigKeys rig;
  std::vector<Section> sections = rig_sections(rig);
  const FileResult<Rig> again = read_rig(uncommented(reference(pointers(sections))), "reference");
  EXPECT_TRUE(again) << text(again.error());
}

}  // namespace
}  // namespace azimuth
