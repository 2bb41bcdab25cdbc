#pragma once
// How well descriptors tell the features of two images apart: Azimuth's and OpenCV's, on the same working squares.

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "slam/perception/sift/sift_perception.hpp"
#include "tests/support/room_views.hpp"

namespace azimuth::test {

struct FeaturesFound {
  std::vector<ImagePlace> places;
  cv::Mat looks;  ///< one descriptor per row
};

/// A method that finds and describes features, and the norm that compares its descriptors.
struct FeatureMethod {
  std::string name;
  std::function<FeaturesFound(const ImageView& image)> find;
  int norm = cv::NORM_L2;
  /// Requires mutual nearest neighbours in addition to the ratio test: if several features have the same nearest
  /// descriptor, only the nearest of them matches. Azimuth matches in this way.
  bool once = false;
};

FeatureMethod azimuth_features(const CameraRig& rig, const SiftSettings& settings, std::string name);
/// Features from OpenCV's "SIFT", "ORB" or "AKAZE", at most `most` per image. OpenCV works on the square that Azimuth's
/// front end cuts out, with its hidden parts filled and masked.
FeatureMethod opencv_features(const CameraRig& rig, const std::string& which, int most, bool once = false);

struct MatchScore {
  int features = 0;  ///< number of features in the first images
  int findable = 0;  ///< features whose point in space also has a feature in the second image
  /// Number of correct matches up to the largest ratio at which 99 % of the matches are correct.
  int right = 0;
  double ratio = 0.0;
  double recall() const { return findable > 0 ? 1.0 * right / findable : 0.0; }
};

/// Score over all pairs of all rooms, with one common ratio.
MatchScore match_score(const std::vector<RoomPairs>& rooms, const FeatureMethod& method);

}  // namespace azimuth::test
