#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/camera/image_axes.hpp"
#include "slam/perception/lamps/bright_runs.hpp"
#include "slam/perception/lamps/gray_view.hpp"

namespace azimuth {

/// Pixels that hang together, corners included, each weighted by how far it is above the threshold: so a pixel at the
/// outline that comes and goes with the noise hardly moves the centroid.
struct LampBlob {
  int area_px = 0;
  int peak = 0;         ///< the brightest value
  double weight = 0.0;  ///< of all pixels together
  Pixel centroid = Pixel::Zero();
  Eigen::Matrix2d spread_px2 = Eigen::Matrix2d::Zero();  ///< covariance of the weighted pixels, each of them a square

  /// The rectangle with the same spread.
  struct Rectangle {
    Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< of its length; to either end
    double length_px = 0.0, thickness_px = 0.0;
  };
  Rectangle rectangle() const;

  /// Area over that of a rectangle with the same spread: 1.05 for ellipses, clearly less where parts of a blob are
  /// joined by something thin, or where it is bent.
  double fill() const;
};

/// Groups runs into blobs (union-find over the runs of neighbouring rows).
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to the most runs.
class LampBlobs {
 public:
  void reserve(std::size_t runs);

  /// `runs` by rows from above, then from left to right, maximal, all inside the image and of pixels of `threshold` or
  /// more. They must stay where they are as long as runs are asked for.
  void group(const GrayView& image, std::span<const PixelRun> runs, int threshold);

  /// In the order of their first runs.
  const std::vector<LampBlob>& all() const { return blobs_; }

  /// Replaces `out` by the runs of a blob, in their order.
  void runs_of(std::size_t blob, std::vector<PixelRun>& out) const;

 private:
  /// Weighted sums over pixels, exact for every blob of less than 1e8 of them.
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
  std::vector<std::uint32_t> parents_;  // of each run: an earlier one of the same blob, or itself
  std::vector<std::uint32_t> numbers_;  // of each run: its blob
  std::vector<std::uint32_t> nexts_;    // of each run: the next of its blob, itself for the last
  std::vector<Ends> ends_;              // of each blob
  std::vector<Sums> sums_;              // of each blob
  std::vector<LampBlob> blobs_;
};

}  // namespace azimuth
