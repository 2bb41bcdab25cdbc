#pragma once
// What is fixed on the robot: the camera's mounting and noise, the odometry's noise and calibration (rig.toml).

#include <array>
#include <optional>
#include <string>

namespace azimuth {

/// How directions reach us. Only `bearings` needs nothing but angles; the image front ends add their own parameters.
enum class FrontEnd { bearings, colour, sift, lamps };

/// A point in the image: u to the right, v down.
using PixelPoint = std::array<double, 2>;

/// The image camera behind the directions, for the image front ends; a source of bearings needs none of it.
/// Absent: rig.toml does not say. Which members a model needs is checked when rig.toml is read.
struct ImageRig {
  std::optional<int> width_px;
  std::optional<int> height_px;
  std::optional<PixelPoint> centre_px;  ///< where the optical axis meets the image
  double beta = 1.0;                    ///< height of a pixel over its width
  int azimuth_direction = -1;           ///< azimuth = direction * atan2(v / beta - v0, u - u0) + offset
  double azimuth_offset_rad = 0.0;
  std::optional<double> viewpoint_height_m;  ///< above the floor
  std::optional<double> sigma_px;            ///< standard deviation of a detection, along u and along v
  std::optional<double> detection_probability;
  std::optional<double> mask_inner_px;  ///< radius about the centre hidden by robot and mounting
  std::optional<double> mask_outer_px;  ///< radius of the mirror's rim
  // "pajdla": r = a tan(theta / b) + c sin(theta / d), theta from the optical axis
  std::optional<double> a_px, b, c_px, d;
  std::optional<double> theta_max_rad;  ///< the model holds up to here
  // "hyperbolic_mirror": z^2 / a^2 - r^2 / b^2 = 1, the camera's optical centre in the other focus
  std::optional<double> mirror_a_mm, mirror_b_mm;
  std::optional<double> focal_length_px;
};

struct CameraRig {
  std::string model = "bearings";                ///< "bearings", "pajdla" or "hyperbolic_mirror"
  double sigma_bearing_rad = 0.0262;             ///< standard deviation of one azimuth
  bool identities = false;                       ///< bearings carry the identity of what was seen
  double field_of_view_rad = 6.283185307179586;  ///< full horizontal angle; 2 pi: all round
  double yaw_offset_rad = 0.0;  ///< of the camera's zero azimuth from the robot's heading, counter-clockwise
  ImageRig image;
};

/// Noise of SPEC I.3 and the corrections that turn raw readings into unbiased motion.
struct OdometryRig {
  std::string kind = "wheel_pose";  ///< cumulative poses, the only kind there is
  // Variances grow with what was driven.
  double lambda_distance_m = 2.5e-3;        ///< variance of distance per metre [m^2/m]
  double lambda_rotation_rad = 1.2120e-3;   ///< variance of each rotation per radian [rad^2/rad]
  double lambda_drift_rad2_per_m = 0.0;     ///< variance of the heading per metre [rad^2/m]
  double sigma_lateral_m_per_sqrt_m = 0.0;  ///< sideways slip, standard deviation after one metre
  double floor_distance_m = 1e-3;           ///< standard deviation added to each step in which the robot moved
  double floor_rotation_rad = 1.745e-3;     ///< likewise for the heading
  // Calibration: true = scale * raw, and a heading that turns by drift_rad_per_m for each metre driven.
  double scale_distance = 1.0;
  double scale_turn = 1.0;
  double drift_rad_per_m = 0.0;
  double lag_s = 0.0;  ///< the robot is at the pose reported for time t at time t + lag
};

struct Rig {
  FrontEnd front_end = FrontEnd::bearings;
  CameraRig camera;
  OdometryRig odometry;
};

}  // namespace azimuth
