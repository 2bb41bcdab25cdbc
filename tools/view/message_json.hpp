#pragma once
// Converts messages to JSON for the page. Numbers that are not finite become null. Reentrant.

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

/// The value; null if it is not finite.
nlohmann::json number_json(double value);
/// As number_json(), rounded to multiples of 1/`per_unit`, for large amounts of data.
nlohmann::json rounded_json(double value, double per_unit);

/// Members: "x", "y", "heading", "covariance" (xx, xy, xh, yy, yh, hh), "odom", "health", "seq", "step", "predicted".
nlohmann::json pose_json(const pose_cov_t& pose);

/// All members of the message under their own names. Texts are shortened to `most_bytes`.
nlohmann::json status_json(const status_t& status, std::size_t most_bytes);

/// Members: "log_bytes", "log_quota_bytes", "disk_free_bytes", and "map_age_s" at the time `wall_us`; null for missing
/// values.
nlohmann::json kept_json(const kept_t& kept, std::int64_t wall_us);

/// The camera's geometry in rig.toml, with which the page draws directions into a picture.
nlohmann::json rig_json(const Rig& rig);

/// Columns "t", "x", "y", "heading". trail_json() has in addition "health", "sigma_m", "sigma_heading_rad", "odom_x",
/// "odom_y", "odom_heading".
nlohmann::json trail_json(std::span<const TrailPoint> points);
nlohmann::json truth_trail_json(std::span<const TrailPoint> points);

/// The text cut to at most `most_bytes`, at a character boundary.
std::string shortened(std::string_view text, std::size_t most_bytes);

}  // namespace azimuth
