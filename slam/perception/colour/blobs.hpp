#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/perception/colour/scan.hpp"

namespace azimuth {

/// A connected set of samples of one class (8-neighbourhood).
struct Blob {
  std::uint8_t class_number = 0;
  int area = 0;            ///< Number of samples
  double perimeter = 0.0;  ///< In sides of a sample
  std::uint32_t first_run = 0;
};

/// Returns 4 pi area / perimeter^2 (mathematics I.11): 1 for a disc, less for any other shape.
double compactness(double area, double perimeter);

/// Groups runs into blobs.
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to the most runs.
class Blobs {
 public:
  /// `runs` must be sorted by row from above, then from left to right, as find_runs() writes them. They must stay valid
  /// as long as this object is asked for blobs.
  void group(std::span<const ColourRun> runs);

  /// All blobs, in the order of their first runs.
  const std::vector<Blob>& all() const { return blobs_; }

  /// Replaces the content of `out` with the runs of one blob, in their order.
  void runs_of(const Blob& blob, std::vector<ColourRun>& out) const;

  /// The class of a sample of the grouped image; 0 if it has none.
  std::uint8_t class_at(int column, int row) const;

 private:
  /// Numbers of samples that have a sample of the same blob in the row above, in the same column or shifted by one
  /// column. The remaining samples lie on the outline.
  struct Overlap {
    int straight = 0, right = 0, left = 0;

    void operator+=(const Overlap& other) {
      straight += other.straight;
      right += other.right;
      left += other.left;
    }
  };
  struct Sums {
    int runs = 0;
    Overlap shared;
  };
  static double perimeter_of(int area, int runs, const Overlap& shared);

  void index_rows();
  void join(std::uint32_t upper, std::uint32_t lower);
  void join_rows(std::size_t upper, std::size_t lower);
  void collect();
  std::uint32_t number_of(std::uint32_t run);
  std::uint32_t root(std::uint32_t run);

  std::span<const ColourRun> runs_;
  std::vector<std::uint32_t> row_starts_;  // Index of the first run of each row, and the end index
  std::vector<std::uint32_t> parents_;     // Of each run: an earlier run of the same blob, or itself.
  std::vector<Overlap> overlaps_;          // Of each run: its overlap with the runs above it.
  std::vector<std::uint32_t> nexts_;       // Of each run: the next run of the same blob.
  std::vector<std::uint32_t> lasts_;       // Of each blob: its last run.
  std::vector<std::uint32_t> numbers_;     // Of each run that is its own parent: the index of its blob.
  std::vector<Sums> sums_;                 // Of each blob: the sums over all its runs.
  std::vector<Blob> blobs_;
};

}  // namespace azimuth
