#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "slam/camera/camera_rig.hpp"
#include "slam/perception/image/row_history.hpp"
#include "slam/perception/image/row_seams.hpp"
#include "slam/perception/image/sample_lattice.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// What an image must not be to be of use. Brightness in 8-bit steps, 0 to 255; shares of the visible samples. They are
/// absolute on purpose: half the light is no trouble as long as something can be seen in it.
struct ImageWatchSettings {
  int dark_below = 24;         ///< this and less is black
  double bright_share = 2e-3;  ///< fewer samples than these brighter than black: dark. A few lamps are enough
  int white_from = 250;
  double white_share = 0.5;  ///< more samples than these white: overexposed
  int contrast_above = 10;   ///< neighbouring samples that differ by more show an edge; noise does not
  double edge_share = 2e-3;  ///< fewer samples than these with an edge: featureless
  int frozen_repeats = 1;    ///< as often the same image again: frozen. Bearings of another instant do harm
  double seam_by = 0.5;      ///< a row that is more of a seam than any other, by so much: torn. See RowSeams
};

/// Judges images one after the other by a few thousand samples of what the rig's mask leaves visible.
///
/// `frozen` says that the image is the same to the last bit for the frozen_repeats-th time. It holds nothing that the
/// first of them did not, so dropping it loses nothing, also when the camera is fine: a simulated one without noise on
/// a robot that stands. Whether it means trouble only shows when the robot has moved meanwhile, which is not known
/// here.
///
/// `torn` says that rows of two instants meet in the image, or that its lower part was filled up for want of more.
/// Where both instants look alike, or show nothing where they meet, that may pass unnoticed, unless the older of them
/// was seen as it was.
///
/// Thread contract: thread-bound. Nothing allocates once an image of the largest size was seen.
class ImageWatch {
 public:
  explicit ImageWatch(const ImageRig& rig, const ImageWatchSettings& settings = {}) : rig_(rig), settings_(settings) {}

  /// The worst that is wrong with the next image. `unreadable`: no readable() image, or not of the rig's size when the
  /// rig says one. Any bytes are safe.
  ImageTrouble judge(const ImageView& image);

  /// How many images in a row before the last readable one were the same.
  int repeats() const { return repeats_; }

 private:
  struct Counts {
    std::size_t bright = 0, white = 0, edges = 0;
  };

  void fit(const FrameFormat& format);
  /// Reads all samples, and the digests of the rows they are in; the digest of these.
  std::uint64_t read(const ImageView& image);
  bool says_something(const SampleLattice::Row& row) const;
  Counts count() const;
  void remember(std::uint64_t digest);
  ImageTrouble trouble(const Counts& counts) const;
  bool is_torn(const ImageView& image);

  ImageRig rig_;
  ImageWatchSettings settings_;
  SampleLattice lattice_;
  FrameFormat format_;  // that the lattice and the seams are for
  RowSeams seams_;
  RowHistory history_;
  std::vector<std::uint8_t> row_;
  std::vector<int> samples_;             // sums over the pixels of each
  std::optional<std::uint64_t> digest_;  // of the last readable image
  int repeats_ = 0;
};

}  // namespace azimuth
