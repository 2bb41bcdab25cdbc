#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/renderer/colour.hpp"
#include "sim/renderer/ray_table.hpp"
#include "sim/renderer/render_scene.hpp"
#include "sim/renderer/texture.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// Paints upright cylinders over the image, farther ones before nearer ones. Pixels on the outline get a mixed colour
/// by coverage, so that the outline can be measured to a fraction of a pixel.
///
/// Thread contract: thread-bound; nothing allocates after construction.
class CylinderPass {
 public:
  CylinderPass(const RenderScene& scene, const CameraSpace& space);

  /// Places the cylinders relative to the camera.
  void place(const Pose2& T_world_camera);
  /// Paints the next `count` cylinders; returns false when none are left.
  bool paint_next(std::size_t count, const RayTable& rays, std::span<PackedColour> image);

 private:
  /// One cylinder relative to the camera.
  struct View {
    float ahead_m, left_m;  ///< Position of the cylinder's axis
    float distance_m;
    float radius_m, low_m, high_m;  ///< Radius; heights of both ends above the camera
    PackedColour paint;
  };
  static void paint(const View& view, const RayTable& rays, std::span<PackedColour> image);
  static float part_seen(const View& view, const PixelRay& ray, PackedColour& colour);

  std::vector<RenderCylinder> cylinders_;
  double ambient_, camera_m_;
  std::vector<View> views_;  // The farthest first
  std::size_t painted_ = 0;
};

/// A rectangle on a surface: a picture, or a light of one colour.
struct Decal {
  float left_m = 0.0F, low_m = 0.0F, right_m = 0.0F, high_m = 0.0F;
  std::optional<Texture> picture;
  PackedColour light = 0;  ///< Used if there is no picture
};

/// One flat side of the room with its decals, in coordinates of its own: `across` and `up`, in metres.
///
/// Thread contract: reentrant.
class Surface {
 public:
  /// `brightness` (256: full) applies to the ground and to pictures; lights are not dimmed.
  Surface(Texture ground, std::vector<Decal> decals, unsigned brightness);

  /// The colour of a pixel that covers a rectangle of this size about the point.
  PackedColour at(float across_m, float up_m, float width_m, float height_m) const;

 private:
  static constexpr float kCell_m = 0.25F;

  void index_decals();
  std::size_t cell(float across_m, float up_m) const;

  Texture ground_;
  std::vector<Decal> decals_;
  unsigned brightness_;
  // A grid over all decals: the decals of cell i are places_[starts_[i] .. starts_[i + 1]).
  float left_m_ = 0.0F, low_m_ = 0.0F;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> starts_, places_;
};

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
