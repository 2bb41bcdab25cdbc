#pragma once
// The fixed properties of the camera (rig.toml, table [camera]).

#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace azimuth {

// The camera models of rig.toml, each with its own parameters only. An unset parameter is NaN and makes the camera
// invalid.

inline constexpr double kNotSet = std::numeric_limits<double>::quiet_NaN();

/// Bearings come from outside: there is no image.
struct BearingsRig {
  static constexpr std::string_view kName = "bearings";
  static constexpr bool kLooksUp = false;
  friend bool operator==(const BearingsRig&, const BearingsRig&) = default;
};

/// Azimuths only: centre, azimuth direction and azimuth offset of the image are known, elevations are not.
struct RadialRig {
  static constexpr std::string_view kName = "radial";
  static constexpr bool kLooksUp = false;
  friend bool operator==(const RadialRig&, const RadialRig&) = default;
};

/// z^2 / a^2 - r^2 / b^2 = 1; the viewpoint is in one focus, the camera's optical centre in the other.
struct HyperbolicMirrorRig {
  static constexpr std::string_view kName = "hyperbolic_mirror";
  static constexpr bool kLooksUp = false;
  double a_mm = kNotSet, b_mm = kNotSet;
  double focal_length_px = kNotSet;
  friend bool operator==(const HyperbolicMirrorRig&, const HyperbolicMirrorRig&) = default;
};

/// r = h tan(pi/4 + elevation/2).
struct ParabolicMirrorRig {
  static constexpr std::string_view kName = "parabolic_mirror";
  static constexpr bool kLooksUp = false;
  double horizon_radius_px = kNotSet;  ///< h
  friend bool operator==(const ParabolicMirrorRig&, const ParabolicMirrorRig&) = default;
};

// Fisheye models also need ImageRig::theta_max_rad; theta is the angle from the optical axis.

/// r = a tan(theta / b) + c sin(theta / d).
struct PajdlaRig {
  static constexpr std::string_view kName = "pajdla";
  static constexpr bool kLooksUp = true;
  double a_px = kNotSet, b = kNotSet, c_px = kNotSet, d = kNotSet;
  friend bool operator==(const PajdlaRig&, const PajdlaRig&) = default;
};

/// r = f theta.
struct EquidistantRig {
  static constexpr std::string_view kName = "equidistant";
  static constexpr bool kLooksUp = true;
  double focal_length_px = kNotSet;  ///< f, in pixels per radian
  friend bool operator==(const EquidistantRig&, const EquidistantRig&) = default;
};

/// theta = atan2(r, -(a0 + a1 r + a2 r^2 + a3 r^3 + a4 r^4)), with r in pixels.
struct PolynomialRig {
  static constexpr std::string_view kName = "polynomial";
  static constexpr bool kLooksUp = true;
  std::array<double, 5> a{kNotSet, 0.0, kNotSet, kNotSet, kNotSet};
  friend bool operator==(const PolynomialRig&, const PolynomialRig&) = default;
};

using ModelRig = std::variant<BearingsRig, RadialRig, HyperbolicMirrorRig, ParabolicMirrorRig, PajdlaRig,
                              EquidistantRig, PolynomialRig>;

/// The model's name in rig.toml.
constexpr std::string_view name(const ModelRig& model) {
  return std::visit([](const auto& each) { return each.kName; }, model);
}

/// Whether the camera looks at the ceiling, so that directions have elevations above the horizon.
constexpr bool looks_up(const ModelRig& model) {
  return std::visit([](const auto& each) { return each.kLooksUp; }, model);
}

/// Whether the directions come from images.
constexpr bool takes_images(const ModelRig& model) { return !std::holds_alternative<BearingsRig>(model); }

/// A parameter of a camera model, by its key in rig.toml.
struct ModelParameter {
  std::string_view key;
  double* value;          ///< Points into the model
  bool is_needed = true;  ///< Whether the model is undefined without this parameter
};

/// All parameters of `model`, as pointers into it.
std::vector<ModelParameter> parameters(ModelRig& model);

/// One default-constructed model of each kind, at its index in ModelRig.
std::array<ModelRig, std::variant_size_v<ModelRig>> all_models();

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
