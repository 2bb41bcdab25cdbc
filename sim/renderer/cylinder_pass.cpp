#include "sim/renderer/cylinder_pass.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth {

namespace {

constexpr double kNearestToAxis_m = 0.02;  // At a distance smaller than this the camera would be inside

/// Diffuse light from above: the sides of a cylinder look darker than its middle.
PackedColour shaded(PackedColour paint, float cos_view) { return dim(paint, fraction256(0.7F + 0.3F * cos_view)); }

}  // namespace

CylinderPass::CylinderPass(const RenderScene& scene, const CameraSpace& space)
    : cylinders_(scene.cylinders), ambient_(scene.ambient), camera_m_(space.camera_m) {
  views_.reserve(cylinders_.size());
}

void CylinderPass::place(const Pose2& T_world_camera) {
  const Pose2 T_camera_world = inverse(T_world_camera);
  views_.clear();
  painted_ = 0;
  for (const RenderCylinder& cylinder : cylinders_) {
    const Eigen::Vector2d p_camera = T_camera_world * cylinder.p_world_m;
    if (p_camera.norm() < cylinder.radius_m + kNearestToAxis_m) continue;
    views_.push_back({to_float(p_camera.x()), to_float(p_camera.y()), to_float(p_camera.norm()),
                      to_float(cylinder.radius_m), to_float(cylinder.low_m - camera_m_),
                      to_float(cylinder.high_m - camera_m_), dim(cylinder.paint, fraction256(to_float(ambient_)))});
  }
  // Of cylinders on one axis, the lower one (the stand) is painted first.
  std::ranges::sort(views_, [](const View& a, const View& b) {
    return a.distance_m != b.distance_m ? a.distance_m > b.distance_m : a.low_m < b.low_m;
  });
}

bool CylinderPass::paint_next(std::size_t count, const RayTable& rays, std::span<PackedColour> image) {
  for (; count > 0 && painted_ < views_.size(); --count) paint(views_[painted_++], rays, image);
  return painted_ < views_.size();
}

void CylinderPass::paint(const View& view, const RayTable& rays, std::span<PackedColour> image) {
  const double half_width_rad = std::asin(std::min(1.0F, view.radius_m / view.distance_m));
  rays.near_azimuth(std::atan2(view.left_m, view.ahead_m), half_width_rad + 0.5 * rays.widest_pixel_rad(),
                    [&](const PixelRay& ray) {
                      PackedColour colour = 0;
                      const float part = part_seen(view, ray, colour);
                      if (part > 0.0F) image[ray.pixel] = mix(image[ray.pixel], colour, fraction256(part));
                    });
}

/* In the plane: the ray passes the axis at the lateral distance `aside`, `along` away from the camera. It enters the
 * circle at along - s and leaves it at along + s, where s^2 = radius^2 - aside^2. A ray just beside the circle is
 * treated as touching it.
 */
float CylinderPass::part_seen(const View& view, const PixelRay& ray, PackedColour& colour) {
  const float along_m = ray.ahead * view.ahead_m + ray.left * view.left_m;
  if (along_m <= 0.0F) return 0.0F;
  const float aside_m = std::abs(ray.ahead * view.left_m - ray.left * view.ahead_m);
  // Widths are angles: aside / along is the tangent of the angle to the axis.
  const float pixel_m = ray.width_per_m * along_m;
  const float sideways = 0.5F + (view.radius_m - aside_m) / pixel_m;
  if (sideways <= 0.0F) return 0.0F;

  const float half_chord_m = std::sqrt(std::max(0.0F, view.radius_m * view.radius_m - aside_m * aside_m));
  const float near_m = along_m - half_chord_m, far_m = along_m + half_chord_m;
  const float near_up_m = near_m * ray.slope, far_up_m = far_m * ray.slope, rise_m = near_m * ray.rise_per_m;
  // From above, the lid is visible from the near edge of the top to its far edge.
  const float topmost_up_m = ray.slope < 0.0F ? far_up_m : near_up_m;
  const float below_top = 0.5F + (view.high_m - topmost_up_m) / rise_m;
  const float above_bottom = 0.5F + (near_up_m - view.low_m) / rise_m;
  if (below_top <= 0.0F || above_bottom <= 0.0F) return 0.0F;
  const bool lid = near_up_m > view.high_m && ray.slope < 0.0F;
  colour = shaded(view.paint, lid ? 1.0F : half_chord_m / view.radius_m);
  return std::min(sideways, 1.0F) * std::min(below_top, 1.0F) * std::min(above_bottom, 1.0F);
}

}  // namespace azimuth
