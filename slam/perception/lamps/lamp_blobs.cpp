#include "slam/perception/lamps/lamp_blobs.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace azimuth {

// A rectangle with sides a and b has moments a^2 / 12 and b^2 / 12.

LampBlob::Rectangle LampBlob::rectangle() const {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(spread_px2);
  const Eigen::Array2d sides_px = (12.0 * axes.eigenvalues().array().max(0.0)).sqrt();
  return {axes.eigenvectors().col(1), sides_px[1], sides_px[0]};
}

double LampBlob::fill() const {
  const double rectangle_px2 = 12.0 * std::sqrt(std::max(spread_px2.determinant(), 0.0));
  return rectangle_px2 > 0.0 ? area_px / rectangle_px2 : 0.0;
}

void LampBlobs::Sums::operator+=(const Sums& other) {
  w += other.w;
  wu += other.wu;
  wv += other.wv;
  wuu += other.wuu;
  wuv += other.wuv;
  wvv += other.wvv;
  area += other.area;
  peak = std::max(peak, other.peak);
}

void LampBlobs::reserve(std::size_t runs) {
  parents_.reserve(runs);
  numbers_.reserve(runs);
  nexts_.reserve(runs);
  ends_.reserve(runs);
  sums_.reserve(runs);
  blobs_.reserve(runs);
}

void LampBlobs::group(const GrayView& image, std::span<const PixelRun> runs, int threshold) {
  runs_ = runs;
  parents_.resize(runs.size());
  for (std::uint32_t i = 0; i < runs.size(); ++i) parents_[i] = i;
  join_neighbours();

  number_blobs();
  sums_.assign(ends_.size(), {});
  for (std::uint32_t i = 0; i < runs.size(); ++i) sums_[numbers_[i]] += sums_of(image, runs[i], threshold);
  blobs_.clear();
  for (const Sums& sums : sums_) blobs_.push_back(blob_of(sums));
}

void LampBlobs::number_blobs() {
  numbers_.resize(runs_.size());
  nexts_.resize(runs_.size());
  ends_.clear();
  for (std::uint32_t run = 0; run < runs_.size(); ++run) append(run);
}

void LampBlobs::append(std::uint32_t run) {
  nexts_[run] = run;
  const std::uint32_t first = root(run);
  if (first == run) {
    numbers_[run] = static_cast<std::uint32_t>(ends_.size());
    ends_.push_back({run, run});
    return;
  }
  numbers_[run] = numbers_[first];
  std::uint32_t& last = ends_[numbers_[run]].last;
  nexts_[last] = run;
  last = run;
}

/// Joins the runs of each row with those of the row above, both from left to right.
void LampBlobs::join_neighbours() {
  std::uint32_t above = 0;
  for (std::uint32_t here = 0; here < runs_.size(); ++here) {
    const PixelRun& run = runs_[here];
    while (runs_[above].row < run.row - 1 || (runs_[above].row == run.row - 1 && runs_[above].last < run.first))
      ++above;
    // The last touching run may also touch the next run, so `above` stays before it.
    for (std::uint32_t k = above; runs_[k].row == run.row - 1 && runs_[k].first <= run.last; ++k) join(k, here);
  }
}

void LampBlobs::join(std::uint32_t a, std::uint32_t b) {
  a = root(a);
  b = root(b);
  parents_[std::max(a, b)] = std::min(a, b);
}

std::uint32_t LampBlobs::root(std::uint32_t run) {
  while (parents_[run] != run) run = parents_[run] = parents_[parents_[run]];
  return run;
}

LampBlobs::Sums LampBlobs::sums_of(const GrayView& image, const PixelRun& run, int threshold) {
  const std::uint8_t* const pixels = image.row(run.row);
  std::uint64_t w = 0, wi = 0, wii = 0;  // i: columns from the first column of the run.
  int peak = 0;
  for (int u = run.first; u < run.last; ++u) {
    const auto weight = static_cast<std::uint64_t>(pixels[u] - threshold + 1),
               i = static_cast<std::uint64_t>(u - run.first);
    w += weight;
    wi += weight * i;
    wii += weight * i * i;
    peak = std::max(peak, static_cast<int>(pixels[u]));
  }
  const auto u0 = static_cast<std::uint64_t>(run.first), v = static_cast<std::uint64_t>(run.row);
  const std::uint64_t wu = wi + u0 * w, wuu = wii + 2 * u0 * wi + u0 * u0 * w;
  return {w, wu, v * w, wuu, v * wu, v * v * w, run.last - run.first, peak};
}

LampBlob LampBlobs::blob_of(const Sums& sums) {
  const auto mean = [&sums](std::uint64_t sum) { return static_cast<double>(sum) / static_cast<double>(sums.w); };
  LampBlob blob{.area_px = sums.area, .peak = sums.peak, .weight = static_cast<double>(sums.w)};
  blob.centroid = {mean(sums.wu), mean(sums.wv)};
  constexpr double kPixel = 1.0 / 12.0;  // The second moment of a pixel's own square
  const double uv = mean(sums.wuv) - blob.centroid.x() * blob.centroid.y();
  blob.spread_px2 << mean(sums.wuu) - blob.centroid.x() * blob.centroid.x() + kPixel, uv, uv,
      mean(sums.wvv) - blob.centroid.y() * blob.centroid.y() + kPixel;
  return blob;
}

void LampBlobs::runs_of(std::size_t blob, std::vector<PixelRun>& out) const {
  out.clear();
  for (std::uint32_t run = ends_[blob].first;; run = nexts_[run]) {
    out.push_back(runs_[run]);
    if (run == nexts_[run]) return;
  }
}

}  // namespace azimuth
