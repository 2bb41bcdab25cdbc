#pragma once
// A direction as a ray from the camera, and the position of a landmark in the ray's tangent plane: unlike azimuth and
// elevation, this has no singularity at the zenith. Which landmarks are in view from a pose, and the density of a
// direction that belongs to none of them.

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/geometry/pose2.hpp"
#include "slam/localisation/known_map.hpp"

namespace azimuth {

/// A measured direction as an orthonormal frame, in the robot's frame. Without an elevation it is horizontal and `up`
/// is not used.
struct SeenRay {
  Eigen::Vector3d along, across, up;
  double variance_across = 0.0, variance_up = 0.0;  ///< [rad^2]
  bool spatial = false;                             ///< The direction has an elevation
  SeenDirection seen;
};

/// Nothing for a direction that is not finite or has no positive sigma.
std::optional<SeenRay> make_ray(const SeenDirection& seen);

/// The horizontal part of a ray, for landmarks of unknown height.
SeenRay flattened(const SeenRay& ray);

/// A camera at some pose in the map.
struct CameraPlace {
  double x_m, y_m, cos, sin, height_m;
  CameraPlace(const Pose2& T_map_body, double camera_height_m)
      : x_m(T_map_body.x_m),
        y_m(T_map_body.y_m),
        cos(std::cos(T_map_body.heading_rad)),
        sin(std::sin(T_map_body.heading_rad)),
        height_m(camera_height_m) {}

  /// Position of a landmark relative to the camera, in the robot's frame; z is 0 where its height is not known.
  Eigen::Vector3d operator()(const KnownLandmark& landmark) const {
    const double dx = landmark.p_map_m.x() - x_m, dy = landmark.p_map_m.y() - y_m;
    return {cos * dx + sin * dy, cos * dy - sin * dx, landmark.has_height() ? landmark.p_map_m.z() - height_m : 0.0};
  }
};

/// The predicted position of a landmark relative to the measured direction.
struct Appearance {
  int rows = 1;                                          ///< 1: across only
  Eigen::Vector2d innovation = Eigen::Vector2d::Zero();  ///< Measured minus predicted, (across, up) [rad]
  Eigen::Matrix<double, 2, 3> by_pose;                   ///< d(predicted) / d(x, y, heading)
  Eigen::Matrix2d noise = Eigen::Matrix2d::Identity();   ///< Noise of the direction and of the landmark's position
};

/* With v = R(heading)^T (q - p), the landmark relative to the camera, and s = along . v:
 *   expected = (across . v / s, up . v / s)
 *   d(expected)/dv = (across - expected_1 along, up - expected_2 along) / s
 *   dv/d(x, y) = -R^T, dv/d(heading) = (v_y, -v_x, 0), dv/dq = R^T
 * Nothing for a landmark behind the camera or nearer than a few centimetres. */
std::optional<Appearance> appearance(const Pose2& T_map_body, const SeenRay& ray, const KnownLandmark& landmark,
                                     double camera_height_m);

/// All pairs of landmarks of known height, sorted by their distance in the plane.
///
/// Thread contract: thread-bound.
class LandmarkPairs {
 public:
  struct Pair {
    double distance_m;
    std::uint16_t a, b;  ///< Indices of the landmarks
  };

  /// Leaves out pairs farther apart than `longest_m`, which cannot be seen together.
  void build(std::span<const KnownLandmark> landmarks, double longest_m);

  /// The pairs whose distance is in this range.
  std::span<const Pair> between(double shortest_m, double longest_m) const;
  bool empty() const { return pairs_.empty(); }

 private:
  std::vector<Pair> pairs_;
};

/// The map in which the robot is searched for.
struct KnownMap {
  std::vector<KnownLandmark> landmarks;
  CameraView view;
  LandmarkPairs pairs;
  double log_prior_density = 0.0;  ///< Prior density of a pose anywhere in the map or near it [1 / (m^2 rad)]
  Eigen::Vector2d low_m, high_m;   ///< Limits of such poses
  double tan_min_elevation = 0.0, tan_inner_elevation = 0.0;

  /// Greatest number of landmarks; further landmarks are left out.
  static constexpr std::size_t kMost = 2000;
  void assign(std::span<const KnownLandmark> all, const CameraView& camera);
  bool contains(const Pose2& T_map_body) const;
};

enum class InView : unsigned char { no, at_the_rim, yes };
InView in_view(const KnownMap& map, const KnownLandmark& landmark, const Eigen::Vector3d& from_camera);

/// The directions of one image.
struct RaysOfImage {
  std::vector<SeenRay> rays;
  std::vector<double> log_room;  ///< ln of the view's size over the share of landmarks each ray may belong to

  /// Takes at most `most` of the directions, at regular intervals.
  void assign(std::span<const SeenDirection> directions, const KnownMap& map, std::size_t most);
};

}  // namespace azimuth
