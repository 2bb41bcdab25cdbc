#pragma once
#include <optional>
#include <span>

#include "picture/canvas.hpp"
#include "slam/camera/camera_model.hpp"
#include "slam/camera/camera_rig.hpp"
#include "slam/camera/image_mask.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/expected_bearing.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Draws what was seen in an image and what was expected: the mask's outlines; for each bearing a radial line in the
/// colour of its kind or, where its elevation tells the place in the image, a circle; outside the rim each mapped
/// landmark's id at its expected azimuth with its gate as an arc or, where an elevation is expected as well, a cross at
/// the place in the image, in the gate's outline. Bearings in nobody's gate stand out in magenta.
///
/// For people: nothing is measured in it, and its look may change.
///
/// Thread contract: thread-bound. Same input, same bytes.
class Picture {
 public:
  explicit Picture(const CameraRig& rig);

  /// The picture in rgb8, larger than the image by Canvas::kMargin_px on each side; valid until the next call. An image
  /// that is not readable is left black. `expected` is what the estimator expected before it used `seen`.
  ImageView draw(const ImageView& image, const BearingSet& seen, std::span<const ExpectedBearing> expected);

 private:
  void draw_mask();
  void draw_expected(const ExpectedBearing& expected);
  bool draw_gate(const ExpectedBearing& expected);
  void draw_seen(const Bearing& bearing, bool is_expected);
  void draw_ring(double radius_px);
  void draw_arc(double radius_px, double from_rad, double to_rad, const PictureColour& colour, int thickness_px);
  void write_captions(const BearingSet& seen, std::size_t expected_seen, std::size_t expected);
  Pixel at(double radius_px, double azimuth_rad) const { return axes_.pixel({radius_px, azimuth_rad}); }

  int width_px_, height_px_;  // of a picture without an image
  ImageAxes axes_;
  MaskShape mask_;
  std::optional<CameraModel> model_;
  double rim_px_ = 0.0;
  Canvas canvas_;
};

}  // namespace azimuth
