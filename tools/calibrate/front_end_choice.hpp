#pragma once
// Chooses the perception front end for a camera by what each front end detects in its images.

#include <array>
#include <string>
#include <vector>

#include "slam/camera/camera_rig.hpp"
#include "slam/perception/colour/colour_perception.hpp"
#include "slam/perception/sift/sift_perception.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Detections in pairs of successive images of one drive. Each vector has one number per pair.
struct FrontEndsSeenAgain {
  std::vector<int> coloured;        ///< coloured landmarks that both images show
  std::vector<int> features;        ///< features in the earlier image
  std::vector<int> features_again;  ///< features of the earlier image with one unambiguous match in the later one
};

/// The colour front end if most pairs show at least three coloured landmarks twice: three bearings determine a pose in
/// the plane, and a coloured landmark has a known kind. Otherwise SIFT, since images always have features.
FrontEnd front_end_for(const FrontEndsSeenAgain& seen);

/// True if SIFT is chosen and the median pair matches too few features to determine a pose.
bool is_doubtful(const FrontEndsSeenAgain& seen);

/// One line that explains the choice to the user.
std::string reason(const FrontEndsSeenAgain& seen);

/// Runs both front ends, with default settings, on pairs of images. Thread contract: thread-bound.
class FrontEndTrial {
 public:
  explicit FrontEndTrial(const CameraRig& rig);

  /// Adds two successive images of a drive. An image that a front end cannot use counts as one without detections.
  void add(const ImageView& earlier, const ImageView& later);
  const FrontEndsSeenAgain& seen() const { return seen_; }

 private:
  // The front ends run without ImageWatch, which would report a frozen camera: one image may end a pair and begin the
  // next one.
  ColourPerception colour_;
  SiftPerception sift_;
  std::array<BearingSet, 2> sets_;
  FrontEndsSeenAgain seen_;
};

}  // namespace azimuth
