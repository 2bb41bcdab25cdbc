#pragma once
// How well features of two images are told apart by their looks: our own and OpenCV's, on the same working squares.

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "slam/perception/sift/sift_perception.hpp"
#include "tests/support/room_views.hpp"

namespace azimuth::test {

struct FeaturesFound {
  std::vector<ImagePlace> places;
  cv::Mat looks;  ///< a row for each
};

/// What finds and describes features, and how their looks are compared.
struct FeatureMethod {
  std::string name;
  std::function<FeaturesFound(const ImageView& image)> find;
  int norm = cv::NORM_L2;
  /// Beside the ratio test: of features whose looks are nearest to the same one only the nearest is it, as Azimuth
  /// tells features apart.
  bool once = false;
};

FeatureMethod azimuth_features(const CameraRig& rig, const SiftSettings& settings, std::string name);
/// "SIFT", "ORB" or "AKAZE" as OpenCV has them, with so many features in an image at most, in the square that our front
/// end cuts out, what is hidden filled and masked.
FeatureMethod opencv_features(const CameraRig& rig, const std::string& which, int most, bool once = false);

struct MatchScore {
  int features = 0;  ///< in first images
  int findable = 0;  ///< of which the second has one that is the same thing
  /// Matched rightly up to the largest ratio at which 99 % of the matches are right.
  int right = 0;
  double ratio = 0.0;
  double recall() const { return findable > 0 ? 1.0 * right / findable : 0.0; }
};

/// Over all pairs of all rooms, with one ratio for all of them.
MatchScore match_score(const std::vector<RoomPairs>& rooms, const FeatureMethod& method);

}  // namespace azimuth::test
