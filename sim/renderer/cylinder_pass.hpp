#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "sim/renderer/ray_table.hpp"
#include "sim/renderer/render_scene.hpp"
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

}  // namespace azimuth
