#pragma once
// The appearance of a rendered world: one rectangular room with its contents. Plain values in the world frame, in
// metres; heights are above the floor.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/renderer/colour.hpp"
#include "sim/world/scenario.hpp"

namespace azimuth {

/// An upright cylinder from `low_m` to `high_m`.
struct RenderCylinder {
  Eigen::Vector2d p_world_m = Eigen::Vector2d::Zero();
  double radius_m = 0.075;
  double low_m = 0.0;
  double high_m = 1.0;
  PackedColour paint = 0;
};

/// The walls of the room, by the direction in which one looks at them.
enum class Wall : std::uint8_t { east = 0, north = 1, west = 2, south = 3 };  // +x, +y, -x, -y

/// A printed sheet on a wall; `seed` determines the picture.
struct RenderPoster {
  Wall wall = Wall::east;
  double along_m = 0.0;  ///< Coordinate of the poster's centre: y on the east and west walls, x on the others
  double middle_m = 1.4;
  double width_m = 0.8;
  double height_m = 0.6;
  std::uint64_t seed = 0;
};

/// A bright rectangle in the ceiling, with sides along x and y.
struct RenderLamp {
  Eigen::Vector2d p_world_m = Eigen::Vector2d::Zero();
  double width_m = 0.6;   ///< Side along x
  double length_m = 0.6;  ///< Side along y
};

struct RenderScene {
  Rectangle room;
  double ceiling_m = 3.0;
  std::vector<RenderCylinder> cylinders;
  std::vector<RenderPoster> posters;
  std::vector<RenderLamp> lamps;
  double ambient = 1.0;  ///< Brightness of everything except the lamps; near 0 behind an infra-red filter
  std::uint64_t seed = 1;
};

/// The scenario's room with a coloured cylinder on a thin stand at each landmark, posters on the walls and a grid of
/// lamps. Neighbouring cylinders have different colours as far as four colours permit.
RenderScene coloured_scene(const Scenario& scenario);

/// The scenario's landmarks as lamps of 0.3 x 1.2 m in a ceiling at `ceiling_m`, seen through an infra-red filter: only
/// the lamps are bright.
RenderScene lamp_scene(const Scenario& scenario, double ceiling_m);

/// The colours of coloured_scene(): red, yellow, green, blue.
inline constexpr std::array<PackedColour, 4> kPaints{colour(215, 25, 30), colour(235, 205, 20), colour(20, 165, 45),
                                                     colour(25, 50, 200)};

}  // namespace azimuth
