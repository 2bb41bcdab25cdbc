// SmootherEstimator: whether an image is of here, where landmarks are all alike.

#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/hindsight/smoother_estimator.hpp"

namespace azimuth {
namespace {

constexpr PoseId kLastImages = 3;  // what none of them showed may be hidden, or was never there
constexpr int kAssignments = 2;
constexpr double kOfUsual = 0.5;        // an image says at least so much of the right place, most often
constexpr double kMostOfAnImage = 4.0;  // ln of odds: what spoils one bearing may spoil them all

}  // namespace

/// Bearings of another place, once they are taken for those of known landmarks, bend path and map for good, and all
/// that is left is a map that fits itself: so it is asked beforehand whether an image is of here. It has a say only
/// where images nearly always speak for the place.
bool SmootherEstimator::is_held_back() {
  if (lost_.is_searched_for()) return !found_by_places();
  if (!lost_.is_in_doubt() && !can_be_lost()) return false;
  if (lost_.is_in_doubt() && !is_seen_anew()) return true;
  judged_from_ = belief_.T_map_body;
  // That there are other things as well says nothing of a robot that explores.
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

/// What hides landmarks in one image hides them in the next one from the same place.
bool SmootherEstimator::is_seen_anew() const {
  const Pose2 since = inverse(judged_from_) * belief_.T_map_body;
  return since.position().norm() >= settings_.relocalisation.key_distance_m ||
         std::abs(since.heading_rad) >= settings_.relocalisation.key_turn_rad;
}

/// Those that the images of the last moment showed, as far as they were mapped.
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

/// The last image against these landmarks, as they are seen from near here: by the odds that it is of them and not of
/// nothing that is mapped. Nothing: it does not say. `mapped` is the share of what is seen that should be of them.
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

/// What a search finds was chosen among many places by what images showed there, and of landmarks all alike some fit
/// anywhere: images that had no say in the choice have to confirm it, and to be explained about as well as they used to
/// be. So they may where odometry has the robot.
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
