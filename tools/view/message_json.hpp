#pragma once
// Messages as the page knows them. Numbers that are none become null. Reentrant.

#include <azimuth/kept_t.hpp>
#include <azimuth/landmark_t.hpp>
#include <azimuth/path_pose_t.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <azimuth/status_t.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "slam/estimator/rig.hpp"
#include "tools/view/trail.hpp"

namespace azimuth {

/// Null of what is no number.
nlohmann::json number_json(double value);
/// The same in whole multiples of 1/`per_unit`, for what there is much of.
nlohmann::json rounded_json(double value, double per_unit);

/// "x", "y", "heading", "covariance" (xx, xy, xh, yy, yh, hh), "odom", "health", "seq", "step", "predicted".
nlohmann::json pose_json(const pose_cov_t& pose);

/// Every member under its own name; texts no longer than `most_bytes`.
nlohmann::json status_json(const status_t& status, std::size_t most_bytes);

/// "log_bytes", "log_quota_bytes", "disk_free_bytes", "map_age_s" at this time; null of what there is none of.
nlohmann::json kept_json(const kept_t& kept, std::int64_t wall_us);

/// The camera's geometry, as far as rig.toml has it: what puts directions into a picture.
nlohmann::json rig_json(const Rig& rig);

/// Columns "t", "x", "y", "heading"; of the estimate also "health", "sigma_m", "sigma_heading_rad", "odom_x", "odom_y",
/// "odom_heading".
nlohmann::json trail_json(std::span<const TrailPoint> points);
nlohmann::json truth_trail_json(std::span<const TrailPoint> points);

/// Text of no more bytes, not cut within a character.
std::string shortened(std::string_view text, std::size_t most_bytes);

}  // namespace azimuth
