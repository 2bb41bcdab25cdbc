#include "tests/support/feature_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <opencv2/features2d.hpp>
#include <utility>

#include "tests/support/opencv_square.hpp"

namespace azimuth::test {
namespace {

constexpr double kPrecision = 0.99;
// Factors from OpenCV's feature size to a blur in pixels: a half for most methods; ORB's size is the width of the
// described patch.
constexpr double kOpenCvScale = 0.5, kOrbScale = 1.6 / 31.0;

cv::Ptr<cv::Feature2D> opencv_method(const std::string& which, int most) {
  if (which == "ORB") return cv::ORB::create(most);
  if (which == "AKAZE") return cv::AKAZE::create();
  return cv::SIFT::create(most);
}

FeaturesFound found(cv::Feature2D& method, int most, const OpenCvSquare& square) {
  std::vector<cv::KeyPoint> points;
  method.detect(square.image, points, square.mask);
  cv::KeyPointsFilter::retainBest(points, most);
  FeaturesFound features;
  method.compute(square.image, points, features.looks);
  const double scale = dynamic_cast<cv::ORB*>(&method) != nullptr ? kOrbScale : kOpenCvScale;
  for (const cv::KeyPoint& point : points) features.places.push_back({point.pt.x, point.pt.y, scale * point.size});
  return features;
}

FeaturesFound found(SiftPerception& perception, const ImageView& image) {
  BearingSet set;
  perception.observe(image, set);
  FeaturesFound features;
  features.looks.create(static_cast<int>(set.descriptors.size()), 128, CV_8U);
  for (std::size_t i = 0; i < set.descriptors.size(); ++i)
    std::ranges::copy(set.descriptors[i].values, features.looks.ptr<std::uint8_t>(static_cast<int>(i)));
  for (const KeyPoint& point : perception.key_points())
    features.places.push_back({point.x_px, point.y_px, point.sigma_px});
  return features;
}

/// Descriptor distances from every feature of the first image to every feature of the second.
cv::Mat distances(const FeaturesFound& first, const FeaturesFound& second, int norm) {
  cv::Mat result;
  if (first.places.empty() || second.places.empty()) return result;
  cv::batchDistance(first.looks, second.looks, result, norm == cv::NORM_HAMMING ? CV_32S : CV_32F, cv::noArray(), norm);
  result.convertTo(result, CV_32F);
  return result;
}

struct Match {
  double ratio = 1.0;
  bool right = false;
};

class PairMatcher {
 public:
  PairMatcher(const FeatureMethod& method, const FeaturesFound& first, const FeaturesFound& second)
      : method_(method), second_(second), distances_(distances(first, second, method.norm)) {}

  /// Number of the feature in the second image whose descriptor is nearest to feature `row` of the first, and the ratio
  /// of its distance to that of the next nearest.
  std::pair<int, double> nearest(int row) const {
    const float* const away = distances_.ptr<float>(row);
    const int best = static_cast<int>(std::min_element(away, away + distances_.cols) - away);
    float rival = std::numeric_limits<float>::infinity();
    for (int j = 0; j < distances_.cols; ++j)
      if (j != best) rival = std::min(rival, away[j]);
    if (rival == 0.0F || (method_.once && is_outdone(row, best))) return {best, 1.0};
    return {best, away[best] / rival};
  }
  bool empty() const { return distances_.empty(); }

 private:
  bool is_outdone(int row, int column) const {
    for (int other = 0; other < distances_.rows; ++other)
      if (distances_.at<float>(other, column) < distances_.at<float>(row, column)) return true;
    return false;
  }

  const FeatureMethod& method_;
  const FeaturesFound& second_;
  cv::Mat distances_;
};

void add_matches(const KnownRoom& room, const RoomPair& pair, const FeatureMethod& method, const FeaturesFound& first,
                 const FeaturesFound& second, std::vector<Match>& matches, MatchScore& score) {
  const PairMatcher matcher(method, first, second);
  score.features += static_cast<int>(first.places.size());
  for (std::size_t i = 0; i < first.places.size() && !matcher.empty(); ++i) {
    const auto expected = room.seen_again(pair, first.places[i]);
    const auto is_it = [&](const ImagePlace& place) { return expected && is_seen_at(*expected, place); };
    if (std::ranges::any_of(second.places, is_it)) ++score.findable;
    const auto [nearest, ratio] = matcher.nearest(static_cast<int>(i));
    if (ratio < 1.0) matches.push_back({ratio, is_it(second.places[static_cast<std::size_t>(nearest)])});
  }
}

/// Accepts as many matches as possible, in the order of their ratio, such that the precision reaches kPrecision.
void choose_ratio(std::vector<Match>& matches, MatchScore& score) {
  std::ranges::stable_sort(matches, std::less{}, &Match::ratio);
  int right = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    right += matches[i].right ? 1 : 0;
    if (right < kPrecision * static_cast<double>(i + 1)) continue;
    score.right = right;
    score.ratio = matches[i].ratio;
  }
}

}  // namespace

FeatureMethod azimuth_features(const CameraRig& rig, const SiftSettings& settings, std::string name) {
  const auto perception = std::make_shared<SiftPerception>(rig, settings);
  return {std::move(name), [perception](const ImageView& image) { return found(*perception, image); }, cv::NORM_L2,
          true};
}

FeatureMethod opencv_features(const CameraRig& rig, const std::string& which, int most, bool once) {
  const cv::Ptr<cv::Feature2D> method = opencv_method(which, most);
  const auto perception = std::make_shared<SiftPerception>(rig, SiftSettings{});
  return {"OpenCV " + which + (once ? ", each once" : ""),
          [=](const ImageView& image) { return found(*method, most, opencv_square(*perception, rig, image)); },
          which == "SIFT" ? cv::NORM_L2 : cv::NORM_HAMMING, once};
}

MatchScore match_score(const std::vector<RoomPairs>& rooms, const FeatureMethod& method) {
  MatchScore score;
  std::vector<Match> matches;
  for (const RoomPairs& room : rooms) {
    const KnownRoom known(room);
    for (const RoomPair& pair : room.pairs)
      add_matches(known, pair, method, method.find(pair.first.view()), method.find(pair.second.view()), matches, score);
  }
  choose_ratio(matches, score);
  return score;
}

}  // namespace azimuth::test
