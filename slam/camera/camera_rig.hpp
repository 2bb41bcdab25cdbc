#pragma once
// The fixed properties of the camera (rig.toml, table [camera]).

#include <array>
#include <optional>
#include <vector>

#include "slam/camera/model_rig.hpp"

namespace azimuth {

/// The source of bearings. `bearings` needs only angles; the image front ends add their own parameters.
enum class FrontEnd { bearings, colour, sift, lamps };

/// A point in the image: u to the right, v down.
using PixelPoint = std::array<double, 2>;
/// Polygons given by their corners, in either sense of rotation.
using PixelPolygons = std::vector<std::vector<PixelPoint>>;

/// Properties of the image camera, for the image front ends; a source of bearings needs none of them. An empty member
/// is absent in rig.toml. settings/model_keys.hpp defines which members a camera model needs; they are checked when
/// rig.toml is read.
struct ImageRig {
  std::optional<int> width_px;
  std::optional<int> height_px;
  std::optional<PixelPoint> centre_px;  ///< The point where the optical axis meets the image
  double beta = 1.0;                    ///< Height of a pixel over its width
  int azimuth_direction = -1;           ///< azimuth = direction * atan2(v / beta - v0, u - u0) + offset
  double azimuth_offset_rad = 0.0;
  std::optional<double> viewpoint_height_m;  ///< Above the floor
  std::optional<double> sigma_px;            ///< Standard deviation of a detection, along u and along v
  std::optional<double> detection_probability;
  std::optional<double> mask_inner_px;  ///< Radius about the centre that robot and mounting hide
  std::optional<double> mask_outer_px;  ///< Radius of the mirror's rim
  PixelPolygons mask_polygons_px;       ///< Further hidden areas: struts, cables, antennas.
  /// The greatest angle from the optical axis at which the camera model, or the fisheye's calibration, is valid.
  std::optional<double> theta_max_rad;
};

struct CameraRig {
  ModelRig model;
  double sigma_bearing_rad = 0.0262;             ///< Standard deviation of one azimuth
  bool identities = false;                       ///< Whether bearings carry the identity of the landmark
  double field_of_view_rad = 6.283185307179586;  ///< Full horizontal angle; 2 pi means all round.
  /// Position of the camera's viewpoint in the robot's frame: x forward, y to the left. The origin is the point to
  /// which odometry refers.
  std::array<double, 2> position_m{};
  double sigma_position_m = 0.02;  ///< Standard deviation of position_m along each axis; 0 means exact.
  double yaw_offset_rad = 0.0;     ///< Counter-clockwise angle from the robot's heading to the camera's zero azimuth
  double sigma_yaw_rad = 0.005;    ///< Standard deviation of yaw_offset_rad; 0 means exact.
  /// Tilt of the camera about the robot's axes: v_level = R_y(pitch) R_x(roll) v_camera (CameraTilt). It applies to
  /// images only; bearings are level.
  double roll_rad = 0.0;   ///< About x (forward); a positive roll lifts the left side.
  double pitch_rad = 0.0;  ///< About y (left); a positive pitch lowers the front.
  /// Standard deviation of roll and of pitch; 0 means exact. Empty: not measured (see sigma_tilt_rad() in
  /// make_camera.hpp).
  std::optional<double> sigma_tilt_rad = {};
  bool azimuths_clockwise = false;  ///< Whether the azimuths of ready-made bearings grow clockwise
  ImageRig image;
};

}  // namespace azimuth
