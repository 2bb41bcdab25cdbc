#include "settings/retired_keys.hpp"

#include <algorithm>

namespace azimuth {
namespace {

/// A table, and its keys up to version 0.1.0, separated by blanks.
struct Retired {
  std::string_view section, keys;
};

constexpr Retired kRetired[] = {
    {"colour",
     "area_max_px2 area_min_px2 centre_within_px compactness_max compactness_min elongation_max "
     "elongation_min fill_max fill_min free_part_min free_within_px full_range_yuv sigma_side_px "
     "straight_within_px straightness_min"},
    {"daemon.camera", "first_image_s"},
    {"daemon.can",
     "bumper_mask bumper_value charging_mask charging_value emergency_stop_mask emergency_stop_value "
     "max_speed_m_s max_turn_rad_s stale_s"},
    {"daemon.fifo", "silent_s"},
    {"daemon.iidc", "dma_buffers iris iso_speed_mbps packet_bytes saturation sharpness"},
    {"daemon.lcm", "print_poses"},
    {"daemon.lcm_source", "max_age_s max_frame_mb silent_s"},
    {"daemon.live", "camera_silent_s"},
    {"daemon.map", "fastest_m_per_s recent_s"},
    {"daemon.picture", "quality"},
    {"daemon.pioneer",
     "distance_mm_per_unit encoder heading_units_per_turn lost_s max_speed_m_s max_turn_rad_s raised_baud "
     "stale_s ticks_per_mm usb_latency_s"},
    {"daemon.realtime", "publisher_cpu publisher_fifo_priority recorder_cpu recorder_fifo_priority"},
    {"daemon.record", "flush_interval_s max_file_age_s max_file_mb"},
    {"daemon.usb", "hotplug reset_after_s"},
    {"daemon.v4l2", "buffers exposure_may_lower_rate formats"},
    {"ekf",
     "best_pair charge_curvature confirm_after_sightings consider_scales estimate_camera_yaw "
     "expire_after_clones gate_chi2 gate_remaining invariant_update inverse_depth_mean_per_m "
     "inverse_depth_sigma_per_m iterate_below_heading_rad joint_gate_probability kl_samples kl_threshold "
     "max_clones max_iterations merge_after_images merge_chi2 merge_within_m min_clone_baseline_m "
     "min_distance_m min_observations new_density_per_rad probation_m promote_linearity "
     "recover_after_rejections relocate_beyond_m relocate_beyond_rad relocation_bearings "
     "relocation_contradiction_chi2 relocation_probability rival_log_ratio second_start_centre_px "
     "sigma_camera_centre_px sigma_camera_yaw_rad start_hypotheses"},
    {"fastslam",
     "association candidate_height_m candidate_height_sigma_m cost detection_probability "
     "far_landmark_penalty gate_sigmas inner_margin key_distance_m likelihood max_candidates max_counter "
     "max_landmarks max_zenith_rad min_cross_points min_parallax_rad min_sightings near_distance_m "
     "new_covariance new_sigma_floor_m new_variance_m2 refute_landmarks relinearise resample_below_share "
     "sigma_floor_rad unexplained_penalty weight"},
    {"identity",
     "combined_sweep_rad enough_in_sight forget_after_m gate_chi2 independent_bearings max_iterations "
     "max_ratio max_views min_observations min_sigma_rad pattern_correlation pattern_members "
     "rivals_elsewhere stable_sightings view_spacing_m views_per_identity"},
    {"lamp_ekf",
     "confirm_after_m confirm_after_sightings confirm_nonlinearity detection_probability forget_log_odds "
     "gate_chi2 inner_margin invariant_update joint_gate_probability judge_every_m max_directions "
     "max_on_probation merge_after_misses merge_chi2 min_height_m most_log_odds new_density_per_sr "
     "probation_m promote_nonlinearity recover_after_images rival_log_ratio second_start_centre_px "
     "sigma_camera_centre_px"},
    {"lamps",
     "blur_px inverse light_share max_area_heights2 max_length_heights min_area_px min_contrast min_fill "
     "min_peak_share noise_factor sigma_per_cut_spread sigma_per_spread sigma_place_px threshold_inertia "
     "threshold_share"},
    {"relocalisation",
     "changed_probability detection_probability doubt_log_odds found_distance_m found_explained "
     "found_images found_probability gate_sigmas history_images key_distance_m key_turn_rad mapped_share "
     "max_directions max_hypotheses refined_poses search_checks seed"},
    {"sift",
     "camera_sigma_px clearance_sigmas clip contrast_light curvature_ratio detector first_sigma_px frame "
     "max_octaves scales_per_octave sectors sigma_place_per_scale sigma_place_px subregion_sigmas "
     "window_subregions"},
    {"smoother",
     "confirm_after_bearings consider_distance kernel kernel_width max_iterations nameless_max_keyframes "
     "replant_after several"},
};

}  // namespace

bool is_retired(std::string_view section, std::string_view key) {
  const auto is_among = [key](std::string_view keys) {
    for (std::size_t at = keys.find(key); at != std::string_view::npos; at = keys.find(key, at + 1)) {
      const std::size_t end = at + key.size();
      if ((at == 0 || keys[at - 1] == ' ') && (end == keys.size() || keys[end] == ' ')) return true;
    }
    return false;
  };
  return std::ranges::any_of(
      kRetired, [&](const Retired& retired) { return retired.section == section && is_among(retired.keys); });
}

}  // namespace azimuth
