#include "settings/configuration.hpp"

#include <numbers>

#include "settings/colour_section.hpp"
#include "settings/configuration_sections.hpp"
#include "settings/file_text.hpp"
#include "settings/path_text.hpp"
#include "settings/reader.hpp"
#include "settings/toml_writing.hpp"

namespace azimuth {
namespace {

Section top_section(Configuration& configuration) {
  return {"",
          "Which estimator runs.",
          {everyday(choice<std::string>(
              "estimator", configuration.estimator,
              {{"by_rig", "by_rig"},
               {"ekf", "ekf"},
               {"lamp_ekf", "lamp_ekf"},
               {"fastslam", "fastslam"},
               {"smoother", "smoother"}},
              "ekf: one joint covariance over pose and landmarks in the plane; lamp_ekf: likewise, with lamps in "
              "space, whose bearings carry elevations; fastslam: particles, for lamps as well; smoother: path and "
              "map by everything seen so far, in the plane; from images and below a ceiling the filter of by_rig "
              "says where the robot is, and the smoother where it was. by_rig: lamp_ekf below a ceiling (front end "
              "lamps, or bearings of a fisheye that looks up), smoother for ready-made bearings, else ekf."))}};
}

std::vector<Key> gate_keys(EkfSettings& ekf) {
  return {
      {"gate_chi2", &ekf.gates.chi2, "Gate on one bearing's squared innovation over its variance; 0: none.",
       from_to(0, 1000)},
      {"joint_gate_probability", &ekf.gates.joint_probability,
       "Joint compatibility: confidence of the chi-square test; 0: none.", from_to(0, 0.999999)},
      {"recover_after_rejections", &ekf.recover_after_rejections,
       "Sightings of a landmark rejected in a row before it is initialised anew; 0: never.", from_to(0, 100000)},
      {"merge_within_m", &ekf.merging.within_m,
       "Landmarks of one known kind nearer to each other than this may be one.", from_to(0, 100)},
      {"merge_chi2", &ekf.merging.chi2,
       "Gate of the distance of two landmarks that may be one, by its covariance, 2 degrees of freedom.",
       above_to(0, 1000)},
      {"merge_after_images", &ekf.merging.after_images,
       "They are merged after as many images in which only one of them was seen; 0: never.", from_to(0, 1000000)},
      everyday({"thinning_s", &ekf.thinning_s, "At most one bearing per landmark in this time; 0: use all.",
                from_to(0, 60)}),
  };
}

std::vector<Key> relocation_keys(EkfSettings& ekf) {
  return {
      {"relocation_bearings", &ekf.relocation.bearings,
       "Named points in one image from which the pose may be found anew, at least 4; 0: never.", from_to(0, 1000)},
      {"relocate_beyond_m", &ekf.relocation.beyond_m, "A pose with a larger standard deviation may be found anew.",
       above_to(0, 10000)},
      {"relocate_beyond_rad", &ekf.relocation.beyond_rad,
       "A pose whose heading has a larger standard deviation may be found anew.", above_to(0, std::numbers::pi)},
      {"relocation_probability", &ekf.relocation.probability,
       "Confidence of the chi-square test of the image against the pose found.", from_to(0.5, 0.9999)},
      {"relocation_contradiction_chi2", &ekf.relocation.contradiction_chi2,
       "Squared distance at which the pose found contradicts the filter's.", above_to(0, 1000)},
  };
}

std::vector<Key> delayed_keys(EkfSettings& ekf) {
  return {
      {"kl_threshold", &ekf.delayed.kl_threshold,
       "Delayed: largest Kullback-Leibler distance of a new landmark; 0: what the paper prints for the rig's "
       "sigma_bearing_rad.",
       from_to(0, 1000)},
      {"kl_samples", &ekf.delayed.kl_samples, "Delayed: Halton points of the Kullback-Leibler distance.",
       from_to(8, 100000)},
      {"min_observations", &ekf.delayed.min_observations, "Delayed: sightings needed before a landmark is initialised.",
       from_to(2, 1000)},
      {"gate_remaining", &ekf.delayed.gate_remaining, "Delayed: gate the bearings applied after an initialisation."},
      {"best_pair", &ekf.delayed.best_pair,
       "Delayed: take the pair with the smallest distance, not the first that passes."},
      {"expire_after_clones", &ekf.delayed.expire_after_clones,
       "Delayed: a candidate not seen while this many clones were made is dropped; 0: never.", from_to(0, 100000)},
      {"min_clone_baseline_m", &ekf.delayed.min_clone_baseline_m,
       "Delayed: a bearing nearer than this to its landmark's last one makes no clone.", from_to(0, 100)},
      {"max_clones", &ekf.delayed.max_clones, "Delayed: past poses kept; the oldest candidates give way.",
       from_to(2, 10000)},
  };
}

std::vector<Key> undelayed_keys(EkfSettings& ekf) {
  return {
      {"inverse_depth_mean_per_m", &ekf.undelayed.inverse_depth_mean_per_m, "Undelayed: first guess of 1 / distance.",
       above_to(0, 100)},
      {"inverse_depth_sigma_per_m", &ekf.undelayed.inverse_depth_sigma_per_m,
       "Undelayed: standard deviation of the first guess of 1 / distance.", above_to(0, 100)},
      {"promote_linearity", &ekf.undelayed.promote_linearity,
       "Undelayed: a landmark whose linearity index falls below this becomes a point.", above_to(0, 10)},
  };
}

std::vector<Key> unknown_identity_keys(EkfSettings& ekf) {
  return {
      {"new_density_per_rad", &ekf.unnamed.new_density_per_rad,
       "Without identities: density of bearings of unmapped things; 0: by rig, 4 in a narrow view, else 0.4 where "
       "bearings come from images and 0.16 where not.",
       from_to(0, 10000)},
      {"rival_log_ratio", &ekf.unnamed.rival_log_ratio,
       "Without identities: a joint hypothesis this near in log-likelihood makes its bearings ambiguous; 0: off.",
       from_to(0, 1000)},
      {"confirm_after_sightings", &ekf.probation.confirm_after_sightings,
       "Without identities: a landmark seen less often is on probation, in images not published; 0: by rig, 8 or 3.",
       from_to(0, 1000)},
      {"probation_m", &ekf.probation.drop_after_m,
       "Without identities: and is dropped when not seen again within this distance driven.", above_to(0, 10000)},
  };
}

std::vector<Key> update_keys(EkfSettings& ekf) {
  return {
      {"max_iterations", &ekf.update.max_iterations, "Iterations of one update at most; 1: the plain EKF.",
       from_to(1, 100)},
      {"iterate_below_heading_rad", &ekf.update.iterate_below_heading_rad,
       "No iteration while the heading's standard deviation is above this.", from_to(0, 10)},
      {"invariant_update", &ekf.update.invariant, "Heading corrections turn the whole map (right-invariant EKF)."},
      {"charge_curvature", &ekf.update.charge_curvature,
       "Bearings from images are charged for what a linear update leaves out while pose, map or centre are vague."},
      {"consider_scales", &ekf.update.consider_scales,
       "What the rig's sigma_... leave unknown of odometer and mounting is in the covariance, and found out where the "
       "drive contradicts it; false: all of it is exact."},
  };
}

std::vector<Key> view_keys(EkfSettings& ekf) {
  return {
      everyday({"max_landmarks", &ekf.max_landmarks, "The map grows no further than this.", from_to(1, 20000)}),
      everyday(
          {"max_viewing_distance_m", &ekf.max_viewing_distance_m, "Nothing farther away is seen.", above_to(0, 10000)}),
      {"min_distance_m", &ekf.min_distance_m, "Bearings of landmarks nearer than this are not used.", above_to(0, 100)},
      {"estimate_camera_yaw", &ekf.camera_yaw.estimate, "Estimate the camera's yaw offset as well."},
      {"sigma_camera_centre_px", &ekf.centre.sigma_px,
       "Standard deviation of the image's centre at the start, a state where bearings come from images; 0: exact.",
       from_to(0, 1000)},
      {"second_start_centre_px", &ekf.centre.second_start_px,
       "Begin a map of coloured landmarks anew, once, when the same images have told the centre to this standard "
       "deviation; 0: never.",
       from_to(0, 1000)},
      {"start_hypotheses", &ekf.unnamed.start_hypotheses,
       "So many hypotheses of which coloured landmark is which are followed in the first metres; 1: only the likeliest "
       "one of each image.",
       from_to(1, 64)},
      {"sigma_camera_yaw_rad", &ekf.camera_yaw.sigma_rad,
       "Standard deviation of the camera's yaw offset at the start, where it is estimated.",
       above_to(0, std::numbers::pi)},
  };
}

std::vector<Key> beginning_keys(Configuration& configuration) {
  return {preset_key(configuration.preset,
                     "Values of the keys not given here. paper: as printed, to compare with: loses one drive in ten."),
          everyday(
              choice<Initialisation>("initialisation", configuration.ekf.initialisation,
                                     {{"by_rig", Initialisation::by_rig},
                                      {"delayed", Initialisation::delayed},
                                      {"undelayed", Initialisation::undelayed}},
                                     "How a landmark enters the map. by_rig: delayed where the camera sees all round, "
                                     "names what it sees, and odometry keeps the heading well; else undelayed. delayed "
                                     "needs names: without them it is undelayed all the same."))};
}

Section ekf_section(Configuration& configuration) {
  EkfSettings& ekf = configuration.ekf;
  return {"ekf", "The bearing-only EKF.",
          joined({beginning_keys(configuration), gate_keys(ekf), relocation_keys(ekf), delayed_keys(ekf),
                  undelayed_keys(ekf), unknown_identity_keys(ekf), update_keys(ekf), view_keys(ekf)})};
}

Section stage_section(StageSettings& stage) {
  return {"stage",
          "Putting samples into the order of their stamps.",
          {everyday({"wait_for_odometry_s", &stage.wait_for_odometry_s,
                     "Bearings whose odometry is missing for longer than this are refused.", from_to(0, 60)})}};
}

/// What was read through `sections`, with the presets' values instead of the defaults: a key that was given wins,
/// wherever its preset stands.
Configuration with_presets(const Configuration& read, const std::vector<Section>& sections) {
  Configuration result = read;
  result.ekf = read.preset == Preset::paper ? paper_preset() : EkfSettings{};
  result.ekf.identity = read.identity_preset == Preset::paper ? paper_identity_preset() : IdentitySettings{};
  result.perception.sift = read.sift_preset == Preset::paper ? paper_sift_preset() : SiftSettings{};
  result.fastslam = fastslam_preset(read.fastslam_preset);
  std::vector<Section> of_result = configuration_sections(result);
  for (std::size_t i = 0; i < sections.size(); ++i) copy_given(sections[i], of_result[i]);
  return result;
}

}  // namespace

std::vector<Section> configuration_sections(Configuration& configuration) {
  std::vector<Section> sections{top_section(configuration), ekf_section(configuration),
                                stage_section(configuration.stage),
                                sift_section(configuration.perception.sift, configuration.sift_preset),
                                identity_section(configuration.ekf.identity, configuration.identity_preset)};
  for (Section& section : colour_sections(configuration.perception.colour)) sections.push_back(std::move(section));
  sections.push_back(lamps_section(configuration.perception.lamps));
  sections.push_back(smoother_section(configuration.smoother));
  sections.push_back(lamp_ekf_section(configuration.lamp_ekf));
  sections.push_back(fastslam_section(configuration.fastslam, configuration.fastslam_preset));
  sections.push_back(health_section(configuration.health));
  sections.push_back(map_section(configuration.map));
  sections.push_back(relocalisation_section(configuration.ekf.relocalisation));
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
  FileErrors violations = read_toml(text, file, tables, others);
  configuration.warnings = place_paths(tables, file);
  for (const std::string& assignment : overrides) {
    if (daemon.empty() && assignment.starts_with("daemon."))
      violations.push_back({"--set " + assignment, 0, "is the daemon's alone: only azimuthd takes it"});
    else
      for (FileError& violation : apply_override(assignment, tables)) violations.push_back(std::move(violation));
  }
  if (!violations.empty()) return failure(std::move(violations));
  return with_presets(configuration, sections);
}

FileResult<Configuration> read_configuration_file(const std::filesystem::path& file,
                                                  std::span<const std::string> overrides,
                                                  std::span<Section* const> daemon) {
  if (file.empty()) return read_configuration("", "", overrides, daemon);
  return file_text(file).and_then(
      [&](const std::string& text) { return read_configuration(text, file.string(), overrides, daemon); });
}

}  // namespace azimuth
