#pragma once
// Circles in an edge map: how well edges follow circles about one centre, and the fit of a circle to them.

#include <opencv2/core.hpp>
#include <vector>

namespace azimuth {

// The edges and the detail that many images of one camera have in common.

/// The edges of a reduced image, averaged over images. An edge with normal direction t contributes m exp(2 i t), where
/// m in [0, 1) grows with its steepness. The doubled angle makes light-to-dark and dark-to-light edges equal. Edges
/// that change direction from image to image cancel; an edge that stays adds up.
struct EdgeMap {
  double scale = 1.0;  ///< Pixels of the map per pixel of the image
  cv::Mat normals;     ///< CV_32FC2: m cos 2t and m sin 2t, where t is the direction of the edge's normal.
  cv::Mat detail;      ///< CV_32FC1: m of all pixels, including pixels that are not on edges.

  // Integer coordinates denote pixel centres, in the map and in the image.
  double to_map(double image_px) const { return (image_px + 0.5) * scale - 0.5; }
  double to_image(double map_px) const { return (map_px + 0.5) / scale - 0.5; }
};

/// Accumulates images into an EdgeMap. Thread contract: thread-bound.
class EdgeMapBuilder {
 public:
  explicit EdgeMapBuilder(double scale) : scale_(scale) {}

  /// `gray` is CV_8UC1. All images must have the same size.
  void add(const cv::Mat& gray);
  /// Returns the mean over all added images. At least one image must have been added.
  EdgeMap build() const;

 private:
  double scale_;
  int images_ = 0;
  cv::Mat normals_, detail_;  // Sums over the images
};

/// A circle in pixels of an edge map.
struct ImageCircle {
  double u = 0.0, v = 0.0, radius = 0.0;
};

/// Evenly spaced directions over the full circle, with their precomputed sines and cosines.
class RayFan {
 public:
  struct Ray {
    double cos, sin;   ///< Cosine and sine of the direction
    float cos2, sin2;  ///< Cosine and sine of twice the direction
  };
  explicit RayFan(int rays);
  const std::vector<Ray>& rays() const { return rays_; }

 private:
  std::vector<Ray> rays_;
};

/// Edge strength along the circle at one of its points: 1 for a steep edge, 0 for none, negative for an edge across the
/// circle.
struct Follows {
  bool in_map = false;
  float value = 0.0F;
};
Follows follows(const EdgeMap& map, const ImageCircle& ring, const RayFan::Ray& ray);

/// Edge strength along rings about one centre with radii `step` apart.
struct RingProfile {
  double first_radius = 0.0, step = 1.0;
  std::vector<double> follows;  ///< Mean edge strength along the part of the ring inside the map
  std::vector<double> in_map;   ///< Share of the ring inside the map

  double radius(std::size_t i) const { return first_radius + step * static_cast<double>(i); }
};

/// Replaces the content of `out` with the profile of `rings` rings, starting with the ring `first`.
void read_profile(const EdgeMap& map, const ImageCircle& first, double step, std::size_t rings, const RayFan& fan,
                  RingProfile& out);

/// Rates how much ring `i` looks like the rim of a mirror. A rim has an edge all round, edges along the circle just
/// inside it (flat objects of the world, seen near the rim) and none just outside. The score is at most 2, and 0 if
/// most of the ring is outside the map.
double rim_score(const RingProfile& profile, std::size_t i);
/// Number of rings on either side of a ring of this radius that rim_score() reads.
std::size_t rim_reach(double radius, double step);

/// Mean detail between two circles whose radii are `from` and `to` times the ring's radius. NaN if hardly any of this
/// area is inside the map.
double detail_between(const EdgeMap& map, const ImageCircle& ring, double from, double to);

/// A circle fitted to edge points, in pixels of the edge map.
struct CircleFit {
  ImageCircle ring;
  double sigma_centre = 0.0;  ///< Standard deviation of the centre in its worst direction
  double sigma_radius = 0.0;
  double seen = 0.0;    ///< Share of the rays inside the map that found the edge on the circle
  double in_map = 0.0;  ///< Share of the circle that lies inside the map
};

/// Fits a circle by robust least squares to the strongest edges near `start`, on rays in all directions. The fit is
/// repeated with a narrowing search window. `seen` is 0 if there is no circle.
CircleFit fit_circle(const EdgeMap& map, const ImageCircle& start);

}  // namespace azimuth
