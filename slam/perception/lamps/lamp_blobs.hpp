#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/camera/image_axes.hpp"
#include "slam/perception/lamps/bright_runs.hpp"

namespace azimuth {

/// A grey image, not owned.
struct GrayView {
  const std::uint8_t* pixels = nullptr;
  std::ptrdiff_t stride = 0;  ///< Bytes from one row to the next
  int width_px = 0;
  int height_px = 0;

  const std::uint8_t* row(int v) const { return pixels + v * stride; }
};

/// A connected set of pixels (8-neighbourhood), each weighted by its excess over the threshold. Because of the weights,
/// pixels at the outline that noise adds or removes hardly move the centroid.
struct LampBlob {
  int area_px = 0;
  int peak = 0;         ///< The greatest pixel value
  double weight = 0.0;  ///< Sum over all pixels
  Pixel centroid = Pixel::Zero();
  /// Covariance of the weighted pixels, each pixel taken as a square
  Eigen::Matrix2d spread_px2 = Eigen::Matrix2d::Zero();

  /// The rectangle with the same spread.
  struct Rectangle {
    Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< Unit vector along the rectangle's length, of either sign
    double length_px = 0.0, thickness_px = 0.0;
  };
  Rectangle rectangle() const;

  /// The blob's area over that of the rectangle with the same spread: 1.05 for ellipses, clearly less for a bent blob
  /// or for parts joined by something thin.
  double fill() const;
};

/// Groups runs into blobs (union-find over the runs of neighbouring rows).
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to the most runs.
class LampBlobs {
 public:
  void reserve(std::size_t runs);

  /// `runs` must be sorted by row from above, then from left to right; they must be maximal, inside the image and
  /// consist of pixels of at least `threshold`. They must stay valid as long as this object is asked for runs.
  void group(const GrayView& image, std::span<const PixelRun> runs, int threshold);

  /// All blobs, in the order of their first runs.
  const std::vector<LampBlob>& all() const { return blobs_; }

  /// Replaces the content of `out` with the runs of a blob, in their order.
  void runs_of(std::size_t blob, std::vector<PixelRun>& out) const;

 private:
  /// Weighted sums over pixels, exact for every blob of less than 1e8 pixels.
  struct Sums {
    std::uint64_t w = 0, wu = 0, wv = 0, wuu = 0, wuv = 0, wvv = 0;
    int area = 0, peak = 0;
    void operator+=(const Sums& other);
  };
  /// The first and the last run of a blob.
  struct Ends {
    std::uint32_t first = 0, last = 0;
  };
  static Sums sums_of(const GrayView& image, const PixelRun& run, int threshold);
  static LampBlob blob_of(const Sums& sums);

  void join_neighbours();
  void number_blobs();
  void append(std::uint32_t run);
  void join(std::uint32_t a, std::uint32_t b);
  std::uint32_t root(std::uint32_t run);

  std::span<const PixelRun> runs_;
  std::vector<std::uint32_t> parents_;  // Of each run: an earlier run of the same blob, or itself.
  std::vector<std::uint32_t> numbers_;  // Of each run: the index of its blob.
  std::vector<std::uint32_t> nexts_;    // Of each run: the next run of its blob, or itself for the last.
  std::vector<Ends> ends_;              // Of each blob
  std::vector<Sums> sums_;              // Of each blob
  std::vector<LampBlob> blobs_;
};

}  // namespace azimuth
