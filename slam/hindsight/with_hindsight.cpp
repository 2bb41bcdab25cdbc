#include "slam/hindsight/with_hindsight.hpp"

namespace azimuth {
namespace {

constexpr int kEstablished = 3;

}  // namespace

WithHindsight::WithHindsight(std::unique_ptr<Estimator> filter, const Rig& rig, const KnownNamesSettings& settings)
    : yaw_offset_rad_(rig.camera.yaw_offset_rad), filter_(std::move(filter)), mapper_({settings}, kEstablished) {}

void WithHindsight::predict(const Motion& motion) {
  filter_->predict(motion);
  mapper_.predict(motion);
}

void WithHindsight::update(const BearingSet& bearings) {
  filter_->update(bearings);
  said_.landmarks.clear();
  said_.accepted.clear();
  filter_->estimate(said_);
  accepted_.stamp = bearings.stamp;
  accepted_.bearings.clear();
  for (const AcceptedSighting& sighting : said_.accepted) {
    Bearing& bearing = accepted_.bearings.emplace_back();
    bearing.azimuth_rad = wrap(sighting.azimuth_rad + yaw_offset_rad_);
    bearing.identity = sighting.landmark_id;
    bearing.sigma_rad = sighting.sigma_rad;
  }
  mapper_.update(accepted_);
  trail_.add(bearings.stamp, mapper_);
}

bool WithHindsight::write_past(std::vector<PastPose>& out) const {
  trail_.write(mapper_, out);
  return true;
}

}  // namespace azimuth
