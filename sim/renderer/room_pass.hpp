#pragma once
#include <array>
#include <span>

#include "sim/renderer/ray_table.hpp"
#include "sim/renderer/render_scene.hpp"
#include "sim/renderer/surface.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// Paints floor, walls and ceiling of a room.
///
/// Thread contract: reentrant.
class RoomPass {
 public:
  RoomPass(const RenderScene& scene, const CameraSpace& space);

  /// Paints the pixel of every ray. The camera must be inside the room.
  void paint(std::span<const PixelRay> rays, const Pose2& T_world_camera, std::span<PackedColour> image) const;

  /// The nearest point to `position` that is well inside the room.
  Eigen::Vector2d inside(const Eigen::Vector2d& position) const;

 private:
  /// The camera's pose in the room, in the form that paint() needs.
  struct View {
    float cos, sin, x_m, y_m;
  };
  struct WallHit {
    float distance_m, across_m, cos_incidence;
    Wall wall;
  };
  PackedColour seen_by(const PixelRay& ray, const View& view) const;
  WallHit hit_wall(float east, float north, const View& view) const;
  PackedColour wall_colour(const PixelRay& ray, const WallHit& hit, float up_m, float rise_m) const;
  PackedColour plane_colour(const PixelRay& ray, float east, float north, const View& view) const;

  Surface floor_, ceiling_;
  std::array<Surface, 4> walls_;  // Indexed by Wall
  float low_x_m_, low_y_m_, high_x_m_, high_y_m_, camera_m_, ceiling_m_;
};

}  // namespace azimuth
