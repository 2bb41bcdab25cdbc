#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "slam/camera/camera_model.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/camera/image_axes.hpp"
#include "slam/camera/image_mask.hpp"
#include "slam/geometry/index.hpp"
#include "slam/perception/colour/blobs.hpp"
#include "slam/perception/colour/class_table.hpp"
#include "slam/perception/colour/colour_settings.hpp"
#include "slam/perception/colour/outline.hpp"
#include "slam/perception/colour/radial_sides.hpp"
#include "slam/perception/colour/scan.hpp"
#include "slam/perception/perception.hpp"

namespace azimuth {

/// Tells which parts of an image show the world; the mask hides the others. The image is divided into samples: squares
/// of `pixels_per_sample` pixels along each side, each of which gets one colour class (scan.hpp). Rows and columns
/// count samples.
///
/// Thread contract: reentrant.
class VisibleArea {
 public:
  /// A sample is visible if all of its pixels are visible.
  VisibleArea(const ImageMask& mask, int width_px, int height_px, int pixels_per_sample);

  /// Sorted by row from above, then from left to right.
  std::span<const VisibleSpan> spans() const { return spans_; }

  /// Whether a sample shows the world; false outside the image.
  bool contains(int column, int row) const {
    if (column < 0 || row < 0 || column >= width_ || row >= height_) return false;
    return visible_[as_size(row) * as_size(width_) + as_size(column)] != 0;
  }

 private:
  int width_, height_;  // samples
  std::vector<std::uint8_t> visible_;
  std::vector<VisibleSpan> spans_;
};

/// Finds upright landmarks painted in one of a few colours (mathematics I.11). For a camera with a vertical optical
/// axis the front end needs only the image centre and the direction in which azimuths grow. If the rig tilts the
/// camera, the rig's camera model supplies elevations, and outlines are mapped to the image of a level camera, in which
/// the sides of upright objects lie along radii. A bearing's kind is the index of its colour class, from 0; its sigma
/// follows from the fit of this outline. The bearing has neither elevation nor identity.
///
/// Supports rgb8, bgr8, yuyv, uyvy, nv12 and the Bayer formats. The trouble is `unreadable` for gray8, which has no
/// colour, for an image of another size than the rig's, and for an image with too many colour runs to be a real scene.
///
/// Thread contract: thread-bound. Allocates for the first image and for each image of a new format or size.
class ColourPerception final : public Perception {
 public:
  ColourPerception(const CameraRig& rig, const ColourSettings& settings);

  void observe(const ImageView& image, BearingSet& out) override;

 private:
  bool prepare(const FrameFormat& format);
  bool group_colours(const ImageView& image);
  std::optional<Bearing> bearing_of(const Blob& blob);
  bool has_landmark_size(const Blob& blob) const;
  bool has_landmark_shape(const Blob& blob, const UprightShape& shape) const;
  std::optional<UprightShape> upright_shape(const Blob& blob);
  bool is_tilted() const { return camera_ && !camera_->is_level(); }
  bool level_outline();
  double level_area_px2(const Blob& blob, const UprightShape& shape) const;

  const CameraRig camera_rig_;
  const ColourSettings settings_;
  FrameFormat format_;  // The format for which the members below are prepared
  ImageAxes axes_;
  std::optional<CameraModel> camera_;  // Set only if the rig tilts the camera
  int pixels_per_sample_ = 1;
  std::optional<VisibleArea> visible_;
  std::optional<ClassTable> table_;
  SampleGrid grid_;
  std::vector<ColourRun> runs_;  // Its size is the greatest permitted number of runs
  Blobs blobs_;
  std::vector<ColourRun> runs_of_blob_;
  std::vector<CentredPoint> outline_;
  RadialSides sides_;
};

}  // namespace azimuth
