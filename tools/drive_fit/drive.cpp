#include "tools/drive_fit/drive.hpp"

#include <algorithm>
#include <utility>

namespace azimuth {
namespace {

constexpr double kPatience_s = 2.0;

}  // namespace

StageSettings with_patience(StageSettings stage) {
  stage.wait_for_odometry_s = std::max(stage.wait_for_odometry_s, kPatience_s);
  return stage;
}

std::size_t Drive::named_bearings() const {
  std::size_t named = 0;
  for (const BearingSet& set : sets)
    named += static_cast<std::size_t>(std::ranges::count_if(
        set.bearings, [](const Bearing& bearing) { return bearing.identity != kUnknownIdentity; }));
  return named;
}

DriveListener::DriveListener(Drive& drive, std::unique_ptr<Estimator> filter)
    : drive_(drive), filter_(std::move(filter)) {}

void DriveListener::predict(const Motion& motion) {
  if (filter_) filter_->predict(motion);
}

void DriveListener::update(const BearingSet& set) {
  if (!filter_) {
    drive_.sets.push_back(set);
    return;
  }
  filter_->update(set);
  said_.landmarks.clear();
  said_.accepted.clear();
  filter_->estimate(said_);
  BearingSet& heard = drive_.sets.emplace_back();
  heard.stamp = set.stamp;
  for (const AcceptedSighting& sighting : said_.accepted) {
    Bearing& bearing = heard.bearings.emplace_back();
    bearing.azimuth_rad = sighting.azimuth_rad;
    bearing.identity = sighting.landmark_id;
    bearing.sigma_rad = sighting.sigma_rad;
    bearing.radius_px = sighting.radius_px;
  }
}

void DriveListener::estimate(Estimate& out) const {
  if (filter_) filter_->estimate(out);
}

void DriveListener::look_ahead(const Motion& motion, Estimate& out) const {
  if (filter_) filter_->look_ahead(motion, out);
}

}  // namespace azimuth
