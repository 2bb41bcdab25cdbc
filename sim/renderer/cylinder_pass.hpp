#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "sim/renderer/ray_table.hpp"
#include "sim/renderer/render_scene.hpp"
#include "slam/geometry/pose2.hpp"

namespace azimuth {

/// Paints upright cylinders over what is painted already, the nearer ones over the farther ones. Their outlines are
/// mixed by what each pixel sees of them, so that they can be found again to a fraction of a pixel.
///
/// Thread contract: thread-bound; nothing allocates after construction.
class CylinderPass {
 public:
  CylinderPass(const RenderScene& scene, const CameraSpace& space);

  /// Puts the cylinders before the camera.
  void place(const Pose2& T_world_camera);
  /// Paints the next `count` of them; false when that was all.
  bool paint_next(std::size_t count, const RayTable& rays, std::span<PackedColour> image);

 private:
  /// One cylinder as it stands before the camera.
  struct View {
    float ahead_m, left_m;  ///< its axis
    float distance_m;
    float radius_m, low_m, high_m;  ///< heights above the camera
    PackedColour paint;
  };
  static void paint(const View& view, const RayTable& rays, std::span<PackedColour> image);
  static float part_seen(const View& view, const PixelRay& ray, PackedColour& colour);

  std::vector<RenderCylinder> cylinders_;
  double ambient_, camera_m_;
  std::vector<View> views_;  // the farthest first
  std::size_t painted_ = 0;
};

}  // namespace azimuth
