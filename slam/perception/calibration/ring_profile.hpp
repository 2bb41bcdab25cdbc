#pragma once
// How far edges follow circles about one centre.

#include <vector>

#include "slam/perception/calibration/edge_map.hpp"

namespace azimuth {

/// In pixels of the map it is about.
struct ImageCircle {
  double u = 0.0, v = 0.0, radius = 0.0;
};

/// Directions evenly all round, with what is needed of each.
class RayFan {
 public:
  struct Ray {
    double cos, sin;   ///< of the direction
    float cos2, sin2;  ///< of twice the direction
  };
  explicit RayFan(int rays);
  const std::vector<Ray>& rays() const { return rays_; }

 private:
  std::vector<Ray> rays_;
};

/// Edge along the circle at a point of it: 1 steep, 0 none, below 0 an edge across.
struct Follows {
  bool in_map = false;
  float value = 0.0F;
};
Follows follows(const EdgeMap& map, const ImageCircle& ring, const RayFan::Ray& ray);

/// Rings about one centre, `step` apart.
struct RingProfile {
  double first_radius = 0.0, step = 1.0;
  std::vector<double> follows;  ///< mean over the part of the ring in the map
  std::vector<double> in_map;   ///< share of the ring

  double radius(std::size_t i) const { return first_radius + step * static_cast<double>(i); }
};

/// Replaces `out`; `rings` of them.
void read_profile(const EdgeMap& map, const ImageCircle& first, double step, std::size_t rings, const RayFan& fan,
                  RingProfile& out);

/// How much ring `i` looks like the rim of a mirror: an edge all round, with edges along the circle also just inside it
/// (what lies flat in the world, near the rim) and none just outside. Up to 2; 0 when most of it is out of the map.
double rim_score(const RingProfile& profile, std::size_t i);
/// Rings on either side of a ring of this radius that rim_score() looks at.
std::size_t rim_reach(double radius, double step);

/// Mean detail between two circles, as shares of the ring's radius; NaN when hardly any of it is in the map.
double detail_between(const EdgeMap& map, const ImageCircle& ring, double from, double to);

}  // namespace azimuth
