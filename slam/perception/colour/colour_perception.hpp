#pragma once
#include <optional>
#include <vector>

#include "slam/camera/camera_model.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/camera/image_axes.hpp"
#include "slam/perception/colour/blobs.hpp"
#include "slam/perception/colour/class_table.hpp"
#include "slam/perception/colour/colour_settings.hpp"
#include "slam/perception/colour/outline.hpp"
#include "slam/perception/colour/radial_sides.hpp"
#include "slam/perception/colour/visible_area.hpp"
#include "slam/perception/perception.hpp"

namespace azimuth {

/// Finds upright landmarks painted in one of a few colours (SPEC I.11): where the optical axis is and which way
/// azimuths grow is all it needs to know of a camera whose axis is vertical. Where it leans, or may lean, the rig's
/// model of the camera says how high things are seen; outlines are then those that a level camera would show, in which
/// upright things have their sides along radii. A bearing's kind is the number of its colour class, from 0, its sigma
/// what this very outline is good for; it has neither elevation nor identity.
///
/// Reads rgb8, bgr8, yuyv, uyvy and the Bayer formats. Trouble `unreadable`: gray8, in which there are no colours; an
/// image of another size than the rig's; one so full of specks of colour that it is none of the world.
///
/// Thread contract: thread-bound. Allocates with the first image and with one of a new format or size, then never.
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
  FrameFormat format_;  // what the members below are made for
  ImageAxes axes_;
  std::optional<CameraModel> camera_;  // where there is a tilt
  int pixels_per_sample_ = 1;
  std::optional<VisibleArea> visible_;
  std::optional<ClassTable> table_;
  SampleGrid grid_;
  std::vector<ColourRun> runs_;  // room for as many as there may be
  Blobs blobs_;
  std::vector<ColourRun> runs_of_blob_;
  std::vector<CentredPoint> outline_;
  RadialSides sides_;
};

}  // namespace azimuth
