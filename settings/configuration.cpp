#include "settings/configuration.hpp"

#include <numbers>

#include "settings/colour_section.hpp"
#include "settings/file_text.hpp"
#include "settings/path_text.hpp"
#include "settings/reader.hpp"
#include "settings/section.hpp"

namespace azimuth {
namespace {

// The tables of azimuth.toml, bound to the settings that they fill.

constexpr Range kInverseDistance = {0, 100, true};

Section top_section(Configuration& configuration) {
  return {"",
          "The estimator and its preset.",
          {choice<EstimatorKind>(
               "estimator", configuration.estimator, estimator_kinds(),
               "Estimator that runs. ekf: one joint covariance over the pose and the landmarks in the plane. lamp_ekf: "
               "the same with lamps in space, whose bearings carry elevations. fastslam: particles, for lamps in "
               "space. smoother: the path and the map from everything seen so far, in the plane; from images and below "
               "a ceiling the filter of by_rig estimates the present pose, and the smoother the past path. by_rig: "
               "lamp_ekf below a ceiling (front end lamps, or bearings of a fisheye that looks up), smoother for "
               "ready-made bearings, else ekf."),
           choice<Preset>(
               "preset", configuration.preset,
               {{"default", Preset::recommended}, {"paper", Preset::paper}, {"paper-7deg", Preset::paper_7deg}},
               "Settings of the filters and of the front end \"sift\". default: the values that measured best. paper: "
               "the values that the two papers print, for comparison; the EKF then loses one drive in ten. paper-7deg: "
               "the same with the other parallax that the FastSLAM paper prints, 7 degrees instead of 1.22 rad.")}};
}

Section ekf_section(EkfSettings& ekf) {
  return {"ekf",
          "The bearing-only EKF, with estimator = \"ekf\".",
          {choice<Initialisation>("initialisation", ekf.initialisation,
                                  {{"by_rig", Initialisation::by_rig},
                                   {"delayed", Initialisation::delayed},
                                   {"undelayed", Initialisation::undelayed}},
                                  "How a landmark enters the map. by_rig: delayed where the camera sees all round, "
                                  "bearings carry names, and odometry keeps the heading well; else undelayed. Bearings "
                                  "without names are always initialised undelayed."),
           {"thinning_s", &ekf.thinning_s, "The filter uses at most one bearing per landmark in this time; 0: all.",
            from_to(0, 60)},
           {"max_landmarks", &ekf.max_landmarks, "Most landmarks in the map.", from_to(1, 20000)},
           {"max_viewing_distance_m", &ekf.max_viewing_distance_m, "The camera sees nothing beyond this distance.",
            above_to(0, 10000)}}};
}

Section stage_section(StageSettings& stage) {
  return {"stage",
          "Samples are put into the order of their stamps.",
          {{"wait_for_odometry_s", &stage.wait_for_odometry_s,
            "Bearings whose odometry is missing for longer than this are refused.", from_to(0, 60)}}};
}

Section sift_section(SiftSettings& sift) {
  return {"sift",
          "Features in the images of the front end \"sift\".",
          {{"side_px", &sift.side_px, "The mirror's disc is shrunk to a square of at most this size; 0: never.",
            from_to(0, 4096)},
           {"contrast", &sift.contrast,
            "Least difference of Gaussians of a feature, for intensities from 0 to 1. Lower values find more features.",
            above_to(0, 1)},
           {"target_count", &sift.target_count, "Most features of one image; 0: all.", from_to(0, 4096)}}};
}

Section identity_section(IdentitySettings& identity) {
  return {"identity",
          "Features are told apart by their looks, where bearings have no names (front end \"sift\").",
          {choice<FeatureValidation>("validation", identity.validation,
                                     {{"geometry", FeatureValidation::geometry},
                                      {"patterns", FeatureValidation::patterns},
                                      {"combined", FeatureValidation::combined}},
                                     "Evidence that confirms a match with a landmark that is not in the map yet. "
                                     "geometry: all its earlier bearings; patterns: the features around it; combined: "
                                     "geometry, and patterns too where geometry allows nearly any direction.")}};
}

Section lamps_section(LampSettings& lamps) {
  return {"lamps",
          "Lamps in the images of the front end \"lamps\".",
          {{"min_elevation_rad", &lamps.min_elevation_rad, "The front end ignores everything below this elevation.",
            from_to(0.02, 1.5)}}};
}

Section smoother_section(HindsightSettings& smoother) {
  return {
      "smoother",
      "Smoother over the whole path and map, with estimator = \"smoother\".",
      {{"names", &smoother.names,
        "Believe the names that bearings carry, where the rig says identities = true. false: tell landmarks apart by "
        "where they are."},
       {"doubt_rig", &smoother.doubt_rig,
        "Estimate odometer, mounting and noise wherever the drive contradicts the rig's values and their sigma_...; "
        "without names, only the camera's heading. false: always believe the rig."},
       {"thinning_s", &smoother.thinning_s, "At most one bearing per named landmark in this time is used; 0: all.",
        from_to(0, 60)},
       {"nameless_thinning_s", &smoother.nameless_thinning_s,
        "Without names, at most one image in this time is used; 0: all.", from_to(0, 60)},
       {"inverse_depth_mean_per_m", &smoother.inverse_depth_mean_per_m,
        "First guess of 1 / distance of a new landmark.", kInverseDistance},
       {"inverse_depth_sigma_per_m", &smoother.inverse_depth_sigma_per_m,
        "Standard deviation of the first guess of 1 / distance.", kInverseDistance},
       {"max_keyframes", &smoother.max_keyframes,
        "Most images of named landmarks that are kept. Beyond this number the images that tell least are marginalised, "
        "so that a drive may last for hours; 0: no limit, and an image costs more the longer the drive is.",
        from_to(0, 1000000)},
       {"members", &smoother.members,
        "Hypotheses that are followed side by side where bearings have no names; 0: 16 where the camera sees all "
        "round, 8 in a narrow view.",
        from_to(0, 256)},
       {"threads", &smoother.threads,
        "Threads of the daemon that compute hypotheses. The estimates are the same with any number.", from_to(1, 64)}}};
}

Section lamp_ekf_section(LampEkfSettings& lamp_ekf) {
  return {
      "lamp_ekf",
      "One EKF over lamps on a ceiling, with estimator = \"lamp_ekf\".",
      {{"max_zenith_rad", &lamp_ekf.view.max_zenith_rad,
        "Directions farther from the zenith than this are not used; 0: the rig's theta_max_rad, at most 1.3.",
        from_to(0, 1.5)},
       {"height_m", &lamp_ekf.height.guess_m, "First guess of a lamp's height above the camera.", above_to(0, 1000)},
       {"height_sigma_m", &lamp_ekf.height.sigma_m,
        "Standard deviation of a lamp's height: two lamps in three hang within this distance of height_m; at most 0.95 "
        "of height_m counts.",
        above_to(0, 1000)},
       {"max_landmarks", &lamp_ekf.max_landmarks, "Most landmarks in the map.", from_to(1, 10000)}}};
}

Section fastslam_section(FastSlamSettings& fastslam) {
  return {"fastslam",
          "FastSLAM over lamps on a ceiling, with estimator = \"fastslam\".",
          {{"particles", &fastslam.particles, "Number of particles; each is a path with a map of its own.",
            from_to(1, 10000)},
           {"seed", &fastslam.seed, "Seed of the random numbers; the same seed gives the same estimates.",
            from_to(0, 2147483647)}}};
}

Section health_section(HealthSettings& health) {
  const Range heading_rad = above_to(0, std::numbers::pi);
  return {
      "health",
      "When an estimate counts as degraded or lost, with any estimator.",
      {{"degraded_after_m", &health.degraded_after_m,
        "Degraded: the robot has driven this far without recognising a landmark.", above_to(0, 100000)},
       {"degraded_sigma_m", &health.degraded_sigma_m,
        "Degraded: the position's standard deviation is above this; 0: above a hundredth of the map's reach (the "
        "distance of its farthest landmark from where the map began), and at least 0.5 m.",
        from_to(0, 1000)},
       {"degraded_sigma_heading_rad", &health.degraded_sigma_heading_rad,
        "Degraded: the heading's standard deviation is above this.", heading_rad},
       {"degraded_centre_px", &health.degraded_centre_px,
        "Degraded: the image's centre is off by more than this, which calls for a calibration; 0: never.",
        from_to(0, 1000)},
       {"degraded_tilt_rad", &health.degraded_tilt_rad,
        "Degraded: the camera's tilt differs significantly from the rig's by more than this, which calls for a "
        "calibration; 0: never.",
        from_to(0, 1)},
       {"degraded_lag_s", &health.degraded_lag_s,
        "Degraded: images and odometry are significantly farther apart in time than this, which calls for a "
        "calibration; 0: never.",
        from_to(0, 10)},
       {"lost_sigma_m", &health.lost_sigma_m,
        "Lost: the position's standard deviation is above this; 0: above a fifth of the map's reach, at least 5 m and "
        "at most 50 m.",
        from_to(0, 1000)},
       {"lost_sigma_heading_rad", &health.lost_sigma_heading_rad,
        "Lost: the heading's standard deviation is above this.", heading_rad}}};
}

Section map_section(MapStart& start) {
  return {"map",
          "How an estimator starts from a saved map, where there is one (daemon.map.file, azimuth replay --map).",
          {choice<MapMode>("mode", start.mode, {{"extend", MapMode::extend}, {"localise", MapMode::localise}},
                           "extend: go on mapping. localise: keep the map as it is, and only find the robot in it."),
           {"pose_known", &start.pose_known,
            "The robot is about where the map saw it last. false: it may be anywhere, and a search finds it first."},
           {"sigma_position_m", &start.sigma_position_m,
            "Pose known: standard deviation of how far the robot may have been moved since, along each axis.",
            from_to(0, 100)},
           {"sigma_heading_rad", &start.sigma_heading_rad,
            "Pose known: standard deviation of how far the robot may have been turned since.",
            from_to(0, std::numbers::pi)},
           {"reach_m", &start.reach_m,
            "Pose not known: how far the robot can be from where the map saw it last. 0: anywhere; a daemon that was "
            "restarted a moment ago still knows how far that can be at most.",
            from_to(0, 1e6)}}};
}

Section relocalisation_section(RelocalisationSettings& relocalisation) {
  return {"relocalisation",
          "How a lost robot is noticed, and found in its map.",
          {{"lost_log_odds", &relocalisation.lost_log_odds,
            "The robot counts as lost, and is searched for anywhere in the map, once the log-odds against its pose "
            "exceed this; 0: never.",
            from_to(0, 1000)}}};
}

/// Every table of azimuth.toml except that of the colours (colour_section.hpp). `configuration` must outlive the
/// tables.
std::vector<Section> estimator_sections(Configuration& configuration) {
  return {top_section(configuration),
          ekf_section(configuration.ekf),
          stage_section(configuration.stage),
          sift_section(configuration.perception.sift),
          identity_section(configuration.ekf.identity),
          lamps_section(configuration.perception.lamps),
          smoother_section(configuration.smoother),
          lamp_ekf_section(configuration.lamp_ekf),
          fastslam_section(configuration.fastslam),
          health_section(configuration.health),
          map_section(configuration.map),
          relocalisation_section(configuration.relocalisation)};
}

void apply_preset(Configuration& configuration) {
  if (configuration.preset == Preset::recommended) return;
  configuration.ekf = paper_preset();
  configuration.relocalisation.lost_log_odds = 0.0;  // neither paper has a relocalisation
  configuration.ekf.identity = paper_identity_preset();
  configuration.perception.sift = paper_sift_preset();
  configuration.fastslam =
      configuration.preset == Preset::paper_7deg ? paper_7deg_fastslam_preset() : paper_fastslam_preset();
}

/// Returns the configuration that was read through `sections`, with the preset's values in place of the defaults. A key
/// that the file gives overrides the preset, wherever the key `preset` is in the file.
Configuration with_preset(const Configuration& read, const std::vector<Section>& sections) {
  Configuration result = read;
  apply_preset(result);
  std::vector<Section> of_result = configuration_sections(result);
  for (std::size_t i = 0; i < sections.size(); ++i) copy_given(sections[i], of_result[i]);
  return result;
}

}  // namespace

std::vector<std::pair<std::string_view, EstimatorKind>> estimator_kinds() {
  return {{"by_rig", EstimatorKind::by_rig},
          {"ekf", EstimatorKind::ekf},
          {"lamp_ekf", EstimatorKind::lamp_ekf},
          {"fastslam", EstimatorKind::fastslam},
          {"smoother", EstimatorKind::smoother}};
}

std::string_view name(EstimatorKind kind) { return estimator_kinds().at(static_cast<std::size_t>(kind)).first; }

std::vector<Section> configuration_sections(Configuration& configuration) {
  std::vector<Section> sections = estimator_sections(configuration);
  sections.push_back(colour_section(configuration.perception.colour));
  return sections;
}

std::string configuration_text(const Configuration& configuration) {
  Configuration copy = configuration;
  std::vector<Section> sections = configuration_sections(copy);
  for (Section& section : sections)
    for (Key& key : section.keys) key.given = true;
  std::string text;
  for (const Section& section : sections) text += toml_text(section);
  return text;
}

FileResult<Configuration> read_configuration(std::string_view text, const std::string& file,
                                             std::span<const std::string> overrides, std::span<Section* const> daemon) {
  static constexpr std::string_view kLeftToTheDaemon[] = {"daemon"};
  Configuration configuration;
  std::vector<Section> sections = configuration_sections(configuration);
  std::vector<Section*> tables = pointers(sections);
  tables.insert(tables.end(), daemon.begin(), daemon.end());

  const auto others =
      daemon.empty() ? std::span<const std::string_view>(kLeftToTheDaemon) : std::span<const std::string_view>();
  FileErrors violations = read_toml(text, file, tables, others, &configuration.warnings);
  for (std::string& warning : place_paths(tables, file)) configuration.warnings.push_back(std::move(warning));
  for (const std::string& assignment : overrides) {
    if (daemon.empty() && assignment.starts_with("daemon."))
      violations.push_back({"--set " + assignment, 0, "is the daemon's alone: only azimuthd takes it"});
    else
      for (FileError& violation : apply_override(assignment, tables)) violations.push_back(std::move(violation));
  }
  if (!violations.empty()) return failure(std::move(violations));
  return with_preset(configuration, sections);
}

FileResult<Configuration> read_configuration_file(const std::filesystem::path& file,
                                                  std::span<const std::string> overrides,
                                                  std::span<Section* const> daemon) {
  if (file.empty()) return read_configuration("", "", overrides, daemon);
  return file_text(file).and_then(
      [&](const std::string& text) { return read_configuration(text, file.string(), overrides, daemon); });
}

}  // namespace azimuth
