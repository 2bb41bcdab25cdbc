#pragma once
// Which front end a camera's images are for, by what each sees in them.

#include <array>
#include <string>
#include <vector>

#include "slam/camera/camera_rig.hpp"
#include "slam/perception/colour/colour_perception.hpp"
#include "slam/perception/sift/sift_perception.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// What was seen in pairs of images, each with the next one of the same drive: one number a pair.
struct FrontEndsSeenAgain {
  std::vector<int> coloured;        ///< landmarks of a colour that the other image shows as well
  std::vector<int> features;        ///< in the earlier image
  std::vector<int> features_again;  ///< of them, those that look like one of the other image and like no second one
};

/// Coloured landmarks fix a pose in the plane by three bearings, and each is one thing of known kind with two sides:
/// where most images show as many, they are what to go by. Else features, of which there are always some.
FrontEnd front_end_for(const FrontEndsSeenAgain& seen);

/// Whether too little is seen again for that front end, by the median pair.
bool is_doubtful(const FrontEndsSeenAgain& seen);

/// In one line: why it is that front end.
std::string reason(const FrontEndsSeenAgain& seen);

/// Looks at pairs of images through both front ends, with default settings. Thread contract: thread-bound.
class FrontEndTrial {
 public:
  explicit FrontEndTrial(const CameraRig& rig);

  /// Two images, the later one taken next after the earlier one. One of no use shows nothing.
  void add(const ImageView& earlier, const ImageView& later);
  const FrontEndsSeenAgain& seen() const { return seen_; }

 private:
  // As they are: an image that is the later one of a pair and the earlier one of the next is no camera that stands
  // still.
  ColourPerception colour_;
  SiftPerception sift_;
  std::array<BearingSet, 2> sets_;
  FrontEndsSeenAgain seen_;
};

}  // namespace azimuth
