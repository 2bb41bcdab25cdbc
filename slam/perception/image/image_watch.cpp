#include "slam/perception/image/image_watch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numeric>

#include "slam/camera/make_camera.hpp"
#include "slam/geometry/index.hpp"
#include "slam/perception/image/gray.hpp"

namespace azimuth {
namespace {

bool visible(const ImageMask& mask, int u, int v) {
  return mask.visible({u, v}) && mask.visible({u + SampleLattice::kSampleWidth_px - 1, v});
}

/// Distance between samples that gives about kMostSamples if the whole image is visible.
int spacing_px(int width_px, int height_px) {
  const double area_px = static_cast<double>(width_px) * height_px;
  return std::max(SampleLattice::kSampleWidth_px,
                  static_cast<int>(std::ceil(std::sqrt(area_px / SampleLattice::kMostSamples))));
}

constexpr std::size_t kNone = ~std::size_t{0};

constexpr int kFewestRows = 3;             // Of either part
constexpr double kShareThatSpeaks = 0.75;  // Share of all rows that must have noise; a camera image has more.

/// Whether the rows of two images are equal up to some row and different after it, or the reverse. Rows without noise
/// are not added.
class Parts {
 public:
  void add(bool same) {
    if (rows_ == 0 || same != same_) ++changes_;
    same_ = same;
    ++rows_;
    ++(same ? same_rows_ : other_rows_);
  }
  int rows() const { return rows_; }
  bool two() const { return changes_ == 2 && same_rows_ >= kFewestRows && other_rows_ >= kFewestRows; }

 private:
  bool same_ = false;
  int changes_ = 0, rows_ = 0, same_rows_ = 0, other_rows_ = 0;
};

constexpr int kSampleWidth = SampleLattice::kSampleWidth_px;

/// Multiplication by an odd number is invertible, so any single changed word changes the digest.
std::uint64_t mixed(std::uint64_t digest, std::uint64_t word) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15U;
  return std::rotl((digest ^ word) * kOdd, 29);
}

/// Processes eight bytes a step.
std::uint64_t digest_of(const std::uint8_t* bytes, std::size_t count) {
  std::uint64_t digest = 0;
  for (std::size_t i = 0; i < count; i += sizeof digest) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, std::min(sizeof word, count - i));
    digest = mixed(digest, word);
  }
  return digest;
}

}  // namespace

RowHistory::RowHistory(std::size_t rows) {
  for (Rows& image : images_) image.resize(rows);
}

bool RowHistory::add() {
  bool torn = false;
  for (std::size_t before = 1; before + 1 <= held_; ++before) torn = torn || has_rows_of(before);
  held_ = std::min(held_ + 1, kImages - 1);
  newest_ = (newest_ + 1) % kImages;
  return torn;
}

bool RowHistory::has_rows_of(std::size_t before) const {
  const Rows &now = image(0), &old = image(before);
  Parts parts;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] != kNothing && is_of_one_instant(before, i)) parts.add(now[i] == old[i]);
  return parts.two() && parts.rows() >= kShareThatSpeaks * static_cast<double>(now.size());
}

bool RowHistory::is_of_one_instant(std::size_t before, std::size_t row) const {
  for (std::size_t other = 1; other <= held_; ++other)
    if (other != before && image(other)[row] == image(before)[row]) return false;
  return true;
}

SampleLattice::SampleLattice(const ImageMask& mask, int width_px, int height_px) {
  const int spacing = spacing_px(width_px, height_px);
  std::vector<std::size_t> above(as_size(width_px / spacing + 1), kNone);
  for (int v = 0; v < height_px; v += spacing) {
    Row row{.v = v, .first_u = width_px, .end_u = 0, .begin = samples_.size(), .end = 0};
    std::size_t left = kNone;
    for (int u = 0; u + kSampleWidth_px <= width_px; u += spacing) {
      std::size_t& here = above[as_size(u / spacing)];
      const std::size_t index = visible(mask, u, v) ? samples_.size() : kNone;
      if (index != kNone) {
        samples_.push_back({u, left == kNone ? index : left, here == kNone ? index : here});
        row.first_u = std::min(row.first_u, u);
        row.end_u = u + kSampleWidth_px;
      }
      left = here = index;
    }
    row.end = samples_.size();
    if (row.end > row.begin) rows_.push_back(row);
  }
}

ImageTrouble ImageWatch::judge(const ImageView& image) {
  if (!image.readable() || !is_size_of(image.format, rig_)) return ImageTrouble::unreadable;
  fit(image.format);
  remember(read(image));
  const bool has_old_rows = history_.add();
  const ImageTrouble found = trouble(count());
  if (found != ImageTrouble::none) return found;
  return has_old_rows || is_torn(image) ? ImageTrouble::torn : ImageTrouble::none;
}

void ImageWatch::fit(const FrameFormat& format) {
  if (format == format_) return;
  format_ = format;
  ImageRig sized = rig_;
  sized.width_px = format.width_px;
  sized.height_px = format.height_px;
  const ImageMask mask(axes_of(sized), mask_of(sized));
  lattice_ = SampleLattice(mask, format.width_px, format.height_px);
  seams_ = RowSeams(mask, format);
  history_ = RowHistory(lattice_.rows().size());
  row_.resize(as_size(format.width_px));
  samples_.resize(lattice_.samples().size());
}

std::uint64_t ImageWatch::read(const ImageView& image) {
  std::uint64_t digest = 0;
  for (std::size_t r = 0; r < lattice_.rows().size(); ++r) {
    const SampleLattice::Row& row = lattice_.rows()[r];
    gray_row(image, row.v, row.first_u, row.end_u, row_.data());
    for (std::size_t i = row.begin; i < row.end; ++i) {
      const std::uint8_t* const first = row_.data() + (lattice_.samples()[i].u - row.first_u);
      samples_[i] = std::accumulate(first, first + kSampleWidth, 0);
    }
    const std::uint64_t of_row = digest_of(row_.data(), as_size(row.end_u - row.first_u));
    history_.newest()[r] = says_something(row) ? of_row : RowHistory::kNothing;
    digest = mixed(digest, of_row);
  }
  return digest;
}

/// Whether enough neighbouring samples of the row differ, because of noise or of the scene.
bool ImageWatch::says_something(const SampleLattice::Row& row) const {
  constexpr std::size_t kOneIn = 4;
  std::size_t changes = 0;
  for (std::size_t i = row.begin; i < row.end; ++i)
    changes += samples_[i] != samples_[lattice_.samples()[i].left] ? 1 : 0;
  return kOneIn * changes >= row.end - row.begin;
}

bool ImageWatch::is_torn(const ImageView& image) {
  return seams_.filled_from(image) >= 0 || seams_.seam(image).stands_out > settings_.seam_by;
}

ImageWatch::Counts ImageWatch::count() const {
  Counts counts;
  const int bright = kSampleWidth * settings_.dark_below, white = kSampleWidth * settings_.white_from,
            contrast = kSampleWidth * settings_.contrast_above;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const SampleLattice::Sample& sample = lattice_.samples()[i];
    const int across = std::abs(samples_[i] - samples_[sample.left]);
    const int down = std::abs(samples_[i] - samples_[sample.above]);
    counts.bright += samples_[i] > bright;
    counts.white += samples_[i] >= white;
    counts.edges += std::max(across, down) > contrast;
  }
  return counts;
}

void ImageWatch::remember(std::uint64_t digest) {
  const bool same = digest_ == digest;
  repeats_ = same ? std::min(repeats_, std::numeric_limits<int>::max() - 1) + 1 : 0;
  digest_ = digest;
}

ImageTrouble ImageWatch::trouble(const Counts& counts) const {
  const auto samples = static_cast<double>(samples_.size());
  const auto share = [samples](std::size_t part) { return static_cast<double>(part) / samples; };
  if (samples_.empty()) return ImageTrouble::none;  // Nothing is visible: the mask is wrong, not the image.
  if (share(counts.bright) < settings_.bright_share) return ImageTrouble::dark;
  if (share(counts.white) > settings_.white_share) return ImageTrouble::overexposed;
  if (share(counts.edges) < settings_.edge_share) return ImageTrouble::featureless;
  return repeats_ >= settings_.frozen_repeats ? ImageTrouble::frozen : ImageTrouble::none;
}

}  // namespace azimuth
