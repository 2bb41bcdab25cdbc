// SmootherEstimator: whether an image fits the believed place, where landmarks all look alike.

#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/hindsight/smoother_estimator.hpp"

namespace azimuth {
namespace {

constexpr PoseId kLastImages = 3;  // a landmark in none of them may be occluded or wrong
constexpr int kAssignments = 2;
constexpr double kOfUsual = 0.5;        // share of the usual evidence that most images of the right place give
constexpr double kMostOfAnImage = 4.0;  // ln of odds; errors in one image are correlated

}  // namespace

/// Whether the image is withheld from the mapper. Bearings from another place that are associated with known landmarks
/// bend path and map for good, and the map then fits itself. So each image is first tested against the believed place.
/// The test counts only where images nearly always support the place.
bool SmootherEstimator::is_held_back() {
  if (lost_.is_searched_for()) return !found_by_places();
  if (!lost_.is_in_doubt() && !can_be_lost()) return false;
  if (lost_.is_in_doubt() && !is_seen_anew()) return true;
  judged_from_ = belief_.T_map_body;
  // Additional bearings do not contradict the place of a robot that explores.
  const std::optional<Compared> image = compared(seen_lately(), belief_, MappedShare(0.0));
  ImageAgreement agreement;
  if (image && usual_odds_.nearly_all_positive()) {
    agreement.expected = static_cast<int>(known_map_.landmarks.size());
    agreement.log_odds = std::clamp(-image->log_odds, -kMostOfAnImage, kMostOfAnImage);
  }
  if (lost_.notices(agreement)) begin_search();
  if (lost_.is_in_doubt() || lost_.is_searched_for()) return true;
  if (image) {
    const auto explained = as_size(image->explained);
    usual_odds_.add(image->log_odds);
    usual_share_.learn(explained, image_.bearings.size() - std::min(explained, image_.bearings.size()));
  }
  return false;
}

/// Whether the robot has moved enough since the last test. An object that occludes landmarks in one image also occludes
/// them in the next image from the same place.
bool SmootherEstimator::is_seen_anew() const {
  const Pose2 since = inverse(judged_from_) * belief_.T_map_body;
  return since.position().norm() >= settings_.relocalisation.key_distance_m ||
         std::abs(since.heading_rad) >= settings_.relocalisation.key_turn_rad;
}

/// The mapped landmarks in the last images, within a short driven distance.
std::vector<HindsightLandmark> SmootherEstimator::seen_lately() const {
  const BearingGraph& graph = mapper_->smoother().graph();
  std::vector<LandmarkId> seen;
  Eigen::Vector2d from = belief_.T_map_body.position();
  double driven_m = 0.0;
  for (PoseId image = graph.poses() - 1; image >= 0 && image >= graph.poses() - kLastImages; --image) {
    driven_m += (graph.pose(image).position() - from).norm();
    from = graph.pose(image).position();
    if (driven_m > kMoment_m) break;
    for (BearingId id = graph.first_bearing_of(image); id < graph.first_bearing_of(image + 1); ++id)
      seen.push_back(graph.landmark_of(id));
  }
  std::vector<HindsightLandmark> landmarks = settled_landmarks();
  std::erase_if(landmarks, [&](const HindsightLandmark& landmark) {
    return std::ranges::find(seen, landmark.in_graph) == seen.end();
  });
  return landmarks;
}

/// Compares the last image with these landmarks from about the pose `here`. The result contains ln of the odds that its
/// bearings are of these landmarks rather than of unmapped ones. Empty when the image shows too little. `mapped` is the
/// expected share of bearings of mapped landmarks.
std::optional<Compared> SmootherEstimator::compared(std::span<const HindsightLandmark> landmarks,
                                                    const PoseGaussian& here, const MappedShare& mapped) {
  if (landmarks.size() < kFewestEstablished || 2 * image_.bearings.size() < landmarks.size()) return std::nullopt;
  known_map_.assign(known(landmarks), view());
  rays_.assign(directions(), known_map_, as_size(settings_.relocalisation.max_directions));
  Beliefs beliefs{.lit = LitOdds(known_map_.landmarks.size(),
                                 static_cast<float>(1.0 - settings_.relocalisation.changed_probability)),
                  .share = mapped};
  return match_.compare(known_map_, rays_, here, beliefs, kAssignments);
}

/// Confirms a candidate pose. A search picks its result among many places by the images so far, and among landmarks
/// that look alike some place always fits. So later images must confirm the candidate about as well as images usually
/// support the right place. The candidate may also be the pose by odometry.
bool SmootherEstimator::found_by_places() {
  if (is_seen_anew()) {
    judged_from_ = belief_.T_map_body;
    const std::vector<HindsightLandmark> settled = settled_landmarks();
    if (const auto image = compared(settled, candidate_, usual_share_)) {
      candidate_ = image->pose;
      const double said = image->log_odds - kOfUsual * usual_odds_.mean();
      candidate_odds_ = std::max(0.0, candidate_odds_ + std::min(said, kMostOfAnImage));
    }
  }
  const std::optional<PoseGaussian> found = look_for_robot();
  if (candidate_odds_ >= settings_.relocalisation.lost_log_odds) {
    mapper_->place(candidate_);
    belief_ = mapper_->pose();
    was_found();
    return true;
  }
  if (found && candidate_odds_ <= 0.0) candidate_ = *found;
  return false;
}

}  // namespace azimuth
