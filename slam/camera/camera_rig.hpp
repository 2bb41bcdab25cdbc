#pragma once
// What is fixed about the camera (rig.toml, table [camera]).

#include <array>
#include <optional>
#include <vector>

#include "slam/camera/model_rig.hpp"

namespace azimuth {

/// How directions reach us. Only `bearings` needs nothing but angles; the image front ends add their own parameters.
enum class FrontEnd { bearings, colour, sift, lamps };

/// A point in the image: u to the right, v down.
using PixelPoint = std::array<double, 2>;
/// Each polygon by its corners, in either sense of rotation.
using PixelPolygons = std::vector<std::vector<PixelPoint>>;

/// The image camera behind the directions, for the image front ends; a source of bearings needs none of it.
/// Absent: rig.toml does not say. Which members a model needs is checked when rig.toml is read
/// (settings/model_keys.hpp).
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
  PixelPolygons mask_polygons_px;       ///< hidden as well: struts, cables, antennas
  /// Directions are known up to here from the optical axis; a fisheye's model holds as far.
  std::optional<double> theta_max_rad;
};

struct CameraRig {
  ModelRig model;
  double sigma_bearing_rad = 0.0262;             ///< standard deviation of one azimuth
  bool identities = false;                       ///< bearings carry the identity of what was seen
  double field_of_view_rad = 6.283185307179586;  ///< full horizontal angle; 2 pi: all round
  /// Of its viewpoint in the robot's frame, whose origin is the point that odometry is of: x forward, y to the left.
  std::array<double, 2> position_m{};
  double sigma_position_m = 0.02;  ///< standard deviation of position_m, along each axis; 0: exact
  double yaw_offset_rad = 0.0;     ///< of the camera's zero azimuth from the robot's heading, counter-clockwise
  double sigma_yaw_rad = 0.005;    ///< standard deviation of yaw_offset_rad; 0: exact
  /// How it leans, about the robot's axes: what is level for the robot is R_y(pitch) R_x(roll) times what is level for
  /// the camera (CameraTilt). Of images alone: bearings are level.
  double roll_rad = 0.0;   ///< about x, forward: a positive one lifts the left side
  double pitch_rad = 0.0;  ///< about y, to the left: a positive one lowers what is ahead
  /// Standard deviation of both; 0: exact. Absent: nobody measured it (make_camera.hpp, sigma_tilt_rad()).
  std::optional<double> sigma_tilt_rad = {};
  bool azimuths_clockwise = false;  ///< bearings that come ready made have azimuths that grow to the right
  ImageRig image;
};

}  // namespace azimuth
