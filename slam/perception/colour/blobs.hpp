#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/perception/colour/colour_run.hpp"

namespace azimuth {

/// Samples of one class that hang together, corners included.
struct Blob {
  std::uint8_t class_number = 0;
  int area = 0;            ///< samples
  double perimeter = 0.0;  ///< sides of a sample
  std::uint32_t first_run = 0;
};

/// 4 pi area / perimeter^2 (SPEC I.11): 1 for a disc, less for everything else.
double compactness(double area, double perimeter);

/// Groups runs into blobs.
///
/// Thread contract: thread-bound. Nothing allocates once storage has grown to the most runs.
class Blobs {
 public:
  /// `runs` by rows from above, then from left to right, as find_runs() writes them. They must stay where they are as
  /// long as blobs are asked for.
  void group(std::span<const ColourRun> runs);

  /// In the order of their first runs.
  const std::vector<Blob>& all() const { return blobs_; }

  /// Replaces `out` by the runs of one blob, in their order.
  void runs_of(const Blob& blob, std::vector<ColourRun>& out) const;

  /// The class of a sample of the image that was grouped; 0: none.
  std::uint8_t class_at(int column, int row) const;

 private:
  /// Samples that have one of the same blob above them, straight or shifted by one: what is left of all samples is
  /// outline.
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
  std::vector<std::uint32_t> row_starts_;  // index of the first run of each row, one more at the end
  std::vector<std::uint32_t> parents_;     // of each run: an earlier one of the same blob, or itself
  std::vector<Overlap> overlaps_;          // of each run with those above it
  std::vector<std::uint32_t> nexts_;       // of each run: the next of the same blob
  std::vector<std::uint32_t> lasts_;       // of each blob
  std::vector<std::uint32_t> numbers_;     // of each run that is its own parent: its blob
  std::vector<Sums> sums_;                 // of each blob, over all its runs
  std::vector<Blob> blobs_;
};

}  // namespace azimuth
