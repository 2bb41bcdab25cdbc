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

/// A mirror as it was found in images.
struct MirrorCircle {
  Circle rim;                    ///< where the reflection ends
  double sigma_centre_px = 0.0;  ///< standard deviation of the centre in its worst direction
  double sigma_radius_px = 0.0;
  double rim_in_image = 0.0;    ///< share of the rim
  double rim_seen = 0.0;        ///< share of that on which an edge lies
  double clearness = 0.0;       ///< of the rim against other circles: 1 and more clear, 0.35 just enough
  std::optional<Circle> inner;  ///< in which camera and robot see themselves
};

/// Finds the mirror of an omnidirectional camera in an image, or better in several of different scenes, without a
/// target: the circle that edges follow all round, within which the world is and beyond which is less to see. The rim
/// may be cut by the image; what surrounds it need not be dark. Its centre is where the optical axis meets the image as
/// far as mirror and lens are aligned.
///
/// Thread contract: thread-bound. Not for the steady state: allocates, and takes a good part of a second.
class MirrorFinder {
 public:
  MirrorFinder();
  ~MirrorFinder();
  MirrorFinder(MirrorFinder&&) noexcept;
  MirrorFinder& operator=(MirrorFinder&&) noexcept;

  /// False, and nothing added: not readable(), smaller than kLeastSide_px or of another size than the first.
  bool add(const ImageView& image);
  int images() const;

  /// Nothing: no circle in these images is surely a mirror.
  std::optional<MirrorCircle> find() const;

  static constexpr int kLeastSide_px = 64;

 private:
  struct Maps;
  std::unique_ptr<Maps> maps_;
};

}  // namespace azimuth
