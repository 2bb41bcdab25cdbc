#include "sim/renderer/passes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace azimuth {
namespace {

constexpr float kMargin_m = 0.5F;  // Around each decal, for pixels that cover a part of it
constexpr std::size_t kOutside = std::numeric_limits<std::size_t>::max();

/// The share of an interval of length `width` about `at` that lies between `low` and `high`. The width is limited to
/// the margin on either side.
float covered(float at, float width, float low, float high) {
  width = std::min(width, 2.0F * kMargin_m);
  const float inside = std::min(high, at + 0.5F * width) - std::max(low, at - 0.5F * width);
  return std::max(inside, 0.0F) / width;
}

constexpr PackedColour kLampLight = colour(255, 255, 250);

unsigned brightness_of(const RenderScene& scene, double part) { return fraction256(to_float(scene.ambient * part)); }

Surface make_wall(const RenderScene& scene, Wall wall, double brightness) {
  std::vector<Decal> decals;
  for (const RenderPoster& poster : scene.posters) {
    if (poster.wall != wall) continue;
    const double half_m = 0.5 * poster.width_m, half_high_m = 0.5 * poster.height_m;
    Decal decal{to_float(poster.along_m - half_m),
                to_float(poster.middle_m - half_high_m),
                to_float(poster.along_m + half_m),
                to_float(poster.middle_m + half_high_m),
                std::nullopt,
                0};
    decal.picture = poster_texture(poster.seed, std::max(poster.width_m, poster.height_m));
    decals.push_back(std::move(decal));
  }
  return {plaster_texture(scene.seed * 8 + 1), std::move(decals), brightness_of(scene, brightness)};
}

Surface make_ceiling(const RenderScene& scene) {
  std::vector<Decal> decals;
  for (const RenderLamp& lamp : scene.lamps) {
    const double half_m = 0.5 * lamp.width_m, half_long_m = 0.5 * lamp.length_m;
    decals.push_back({to_float(lamp.p_world_m.x() - half_m), to_float(lamp.p_world_m.y() - half_long_m),
                      to_float(lamp.p_world_m.x() + half_m), to_float(lamp.p_world_m.y() + half_long_m), std::nullopt,
                      kLampLight});
  }
  return {plaster_texture(scene.seed * 8 + 2), std::move(decals), brightness_of(scene, 0.55)};
}

constexpr double kNearestToAxis_m = 0.02;  // At a distance smaller than this the camera would be inside

/// Diffuse light from above: the sides of a cylinder look darker than its middle.
PackedColour shaded(PackedColour paint, float cos_view) { return dim(paint, fraction256(0.7F + 0.3F * cos_view)); }

}  // namespace

Surface::Surface(Texture ground, std::vector<Decal> decals, unsigned brightness)
    : ground_(std::move(ground)), decals_(std::move(decals)), brightness_(brightness) {
  if (!decals_.empty()) index_decals();
}

void Surface::index_decals() {
  float right_m = std::numeric_limits<float>::lowest(), high_m = right_m;
  left_m_ = low_m_ = std::numeric_limits<float>::max();
  for (const Decal& decal : decals_) {
    left_m_ = std::min(left_m_, decal.left_m - kMargin_m);
    low_m_ = std::min(low_m_, decal.low_m - kMargin_m);
    right_m = std::max(right_m, decal.right_m + kMargin_m);
    high_m = std::max(high_m, decal.high_m + kMargin_m);
  }
  columns_ = static_cast<std::size_t>((right_m - left_m_) / kCell_m) + 1;
  rows_ = static_cast<std::size_t>((high_m - low_m_) / kCell_m) + 1;
  const auto place = [](float at, float low) { return static_cast<std::size_t>((at - low) / kCell_m); };
  std::vector<std::vector<std::uint32_t>> cells(columns_ * rows_);
  for (std::uint32_t i = 0; i < decals_.size(); ++i) {
    const Decal& decal = decals_[i];
    for (std::size_t y = place(decal.low_m - kMargin_m, low_m_); y <= place(decal.high_m + kMargin_m, low_m_); ++y) {
      for (std::size_t x = place(decal.left_m - kMargin_m, left_m_); x <= place(decal.right_m + kMargin_m, left_m_);
           ++x) {
        cells[y * columns_ + x].push_back(i);
      }
    }
  }
  starts_.push_back(0);
  for (const std::vector<std::uint32_t>& each : cells) {
    places_.insert(places_.end(), each.begin(), each.end());
    starts_.push_back(static_cast<std::uint32_t>(places_.size()));
  }
}

std::size_t Surface::cell(float across_m, float up_m) const {
  const float x = (across_m - left_m_) / kCell_m, y = (up_m - low_m_) / kCell_m;
  if (!(x >= 0.0F && y >= 0.0F && x < static_cast<float>(columns_) && y < static_cast<float>(rows_))) return kOutside;
  return static_cast<std::size_t>(y) * columns_ + static_cast<std::size_t>(x);
}

PackedColour Surface::at(float across_m, float up_m, float width_m, float height_m) const {
  const float footprint_m = std::sqrt(width_m * height_m);
  PackedColour seen = dim(ground_.at(across_m, up_m, ground_.level(footprint_m)), brightness_);
  const std::size_t here = cell(across_m, up_m);
  if (here == kOutside) return seen;
  for (std::uint32_t i = starts_[here]; i < starts_[here + 1]; ++i) {
    const Decal& decal = decals_[places_[i]];
    const float part =
        covered(across_m, width_m, decal.left_m, decal.right_m) * covered(up_m, height_m, decal.low_m, decal.high_m);
    if (part <= 0.0F) continue;
    const PackedColour face =
        decal.picture
            ? dim(decal.picture->at(across_m - decal.left_m, decal.high_m - up_m, decal.picture->level(footprint_m)),
                  brightness_)
            : decal.light;
    seen = mix(seen, face, fraction256(part));
  }
  return seen;
}

// The walls have different brightness, with a little more light from the east, so that no two neighbouring walls look
// alike.
RoomPass::RoomPass(const RenderScene& scene, const CameraSpace& space)
    : floor_(floor_texture(scene.seed * 8), {}, brightness_of(scene, 1.0)),
      ceiling_(make_ceiling(scene)),
      walls_{make_wall(scene, Wall::east, 0.86), make_wall(scene, Wall::north, 0.93), make_wall(scene, Wall::west, 1.0),
             make_wall(scene, Wall::south, 0.79)},
      low_x_m_(to_float(scene.room.low_m.x())),
      low_y_m_(to_float(scene.room.low_m.y())),
      high_x_m_(to_float(scene.room.high_m.x())),
      high_y_m_(to_float(scene.room.high_m.y())),
      camera_m_(to_float(space.camera_m)),
      ceiling_m_(to_float(space.ceiling_m)) {}

Eigen::Vector2d RoomPass::inside(const Eigen::Vector2d& position) const {
  constexpr double kNearest_m = 0.05;
  return {std::clamp(position.x(), low_x_m_ + kNearest_m, high_x_m_ - kNearest_m),
          std::clamp(position.y(), low_y_m_ + kNearest_m, high_y_m_ - kNearest_m)};
}

void RoomPass::paint(std::span<const PixelRay> rays, const Pose2& T_world_camera, std::span<PackedColour> image) const {
  const View view{to_float(std::cos(T_world_camera.heading_rad)), to_float(std::sin(T_world_camera.heading_rad)),
                  to_float(T_world_camera.x_m), to_float(T_world_camera.y_m)};
  for (const PixelRay& ray : rays) image[ray.pixel] = seen_by(ray, view);
}

/// `east` and `north` are the ray's components in the world. A ray parallel to a wall meets it at infinite distance.
RoomPass::WallHit RoomPass::hit_wall(float east, float north, const View& view) const {
  const float to_x_m = (east > 0.0F ? high_x_m_ - view.x_m : view.x_m - low_x_m_) / std::abs(east);
  const float to_y_m = (north > 0.0F ? high_y_m_ - view.y_m : view.y_m - low_y_m_) / std::abs(north);
  if (to_x_m < to_y_m)
    return {to_x_m, view.y_m + to_x_m * north, std::abs(east), east > 0.0F ? Wall::east : Wall::west};
  return {to_y_m, view.x_m + to_y_m * east, std::abs(north), north > 0.0F ? Wall::north : Wall::south};
}

PackedColour RoomPass::wall_colour(const PixelRay& ray, const WallHit& hit, float up_m, float rise_m) const {
  const float width_m = hit.distance_m * ray.width_per_m / hit.cos_incidence;
  return walls_[static_cast<std::size_t>(hit.wall)].at(hit.across_m, up_m, width_m, rise_m);
}

/// Far away, a pixel covers a strip of the plane that is longer than it is wide. It is approximated by the
/// axis-parallel rectangle with the same moments.
PackedColour RoomPass::plane_colour(const PixelRay& ray, float east, float north, const View& view) const {
  const float x_m = view.x_m + ray.plane_distance_m * east, y_m = view.y_m + ray.plane_distance_m * north;
  const float depth_m = ray.plane_depth_m, side_m = ray.plane_distance_m * ray.width_per_m;
  const float depth_m2 = depth_m * depth_m, side_m2 = side_m * side_m;
  const float east2 = east * east, north2 = north * north;
  return (ray.slope > 0.0F ? ceiling_ : floor_)
      .at(x_m, y_m, std::sqrt(east2 * depth_m2 + north2 * side_m2), std::sqrt(north2 * depth_m2 + east2 * side_m2));
}

/// Near the edge between wall and floor or ceiling, a pixel covers parts of both.
PackedColour RoomPass::seen_by(const PixelRay& ray, const View& view) const {
  const float east = view.cos * ray.ahead - view.sin * ray.left, north = view.sin * ray.ahead + view.cos * ray.left;
  const WallHit hit = hit_wall(east, north, view);
  const float up_m = camera_m_ + hit.distance_m * ray.slope, rise_m = hit.distance_m * ray.rise_per_m;
  const float above_edge_m = ray.slope > 0.0F ? ceiling_m_ - up_m : up_m;
  const float wall_part = 0.5F + above_edge_m / rise_m;
  if (wall_part <= 0.0F) return plane_colour(ray, east, north, view);
  const PackedColour wall = wall_colour(ray, hit, up_m, rise_m);
  if (wall_part >= 1.0F) return wall;
  return mix(plane_colour(ray, east, north, view), wall, fraction256(wall_part));
}

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
