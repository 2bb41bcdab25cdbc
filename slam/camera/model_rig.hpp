#pragma once
// The camera models of rig.toml, each with its own parameters only. An unset parameter is NaN and makes the camera
// invalid.

#include <array>
#include <limits>
#include <string_view>
#include <variant>

namespace azimuth {

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

}  // namespace azimuth
