#pragma once
#include <memory>
#include <optional>

#include "slam/camera/image_axes.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

struct Circle {
  Pixel centre_px = Pixel::Zero();
  double radius_px = 0.0;
};

/// The circles of a mirror, as found in images.
struct MirrorCircle {
  Circle rim;                    ///< The circle at which the reflection ends
  double sigma_centre_px = 0.0;  ///< Standard deviation of the centre in its worst direction
  double sigma_radius_px = 0.0;
  double rim_in_image = 0.0;  ///< Share of the rim that lies inside the image
  double rim_seen = 0.0;      ///< Share of the visible rim on which an edge was found
  /// Distinctness of the rim from other circles: 1 or more is clear, 0.35 is just enough.
  double clearness = 0.0;
  std::optional<Circle> inner;  ///< The disc in which camera and robot see themselves, if found
};

/// Finds the mirror of an omnidirectional camera without a target, from one image or, better, from several images of
/// different scenes. The mirror's rim is the circle along which edges run all round, with more detail inside than
/// outside. The image border may cut the rim, and the surroundings of the mirror need not be dark. The rim's centre is
/// the point at which the optical axis meets the image, up to misalignment of mirror and lens.
///
/// Thread contract: thread-bound. Not for the steady state: it allocates and takes a considerable part of a second.
class MirrorFinder {
 public:
  MirrorFinder();
  ~MirrorFinder();
  MirrorFinder(MirrorFinder&&) noexcept;
  MirrorFinder& operator=(MirrorFinder&&) noexcept;

  /// Returns false and adds nothing if the image is not readable(), smaller than kLeastSide_px or of another size than
  /// the first image.
  bool add(const ImageView& image);
  int images() const;

  /// Returns nullopt if no circle in the images is clearly a mirror.
  std::optional<MirrorCircle> find() const;

  static constexpr int kLeastSide_px = 64;

 private:
  struct Maps;
  std::unique_ptr<Maps> maps_;
};

}  // namespace azimuth
