#include "daemon/pipeline/estimator_turn.hpp"

#include <utility>

#include "daemon/pipeline/paces.hpp"
#include "daemon/pipeline/storage.hpp"
#include "slam/estimator/estimate.hpp"

namespace azimuth {

EstimatorTurn::EstimatorTurn(EstimatorStage stage, Wires wires, Doorbell& bell)
    : stage_(std::move(stage)), wires_(wires), bell_(bell) {
  for (BearingSet* set : {&set_, &echo_, &taken_.bearings}) prepare(*set);
  prepare(result_);
  prepare(prediction_);
  if (wires_.expected_images || tells_expectations())
    stage_.before_update([this](const BearingSet& set, const Estimator& estimator) { look_on(set, estimator); });
}

void EstimatorTurn::operator()() {
  bell_.wait(kNap);
  // Read before draining: when it is true, all samples are already in the wires.
  const bool over = wires_.samples_over.is_set();
  drain_samples(over);
  if (over) stage_.finish();
  while (advance()) wires_.estimates.publish(result_);
  if (stage_.look_ahead(prediction_)) wires_.predictions.publish(prediction_);
  if (wires_.map_storage.take(map_)) hand_over_map();
  if (wires_.path_storage.take(path_)) hand_over_path();
  if (wires_.ways) hand_over_way();
  if (!told_of_start_) tell_of_start();
  tell_of_samples(over);
  if (over && !wires_.estimates_over.is_set()) hand_over_path();
  if (over) wires_.estimates_over.set();
}

/// The storage of result_ is recycled and may hold the expected bearings of an older image, so their stamp is reset.
bool EstimatorTurn::advance() {
  result_.expected.stamp.reset();
  if (!stage_.advance(result_.estimate)) return false;
  if (wires_.expected_images) ids_of(result_.estimate.landmarks, in_map_);
  digest_.add(result_.estimate);
  result_.digest = digest_.value();
  return true;
}

/// Takes samples in the order of their stamps, as a replay does and as the log must have them. While the sources still
/// run, a turn takes at most one ring of samples of either kind. The samples taken are echoed to the publisher and
/// recorded, because a replay needs exactly these for the same estimates.
void EstimatorTurn::drain_samples(bool over) {
  std::size_t sets = 0, readings = 0;
  while (over || (sets < kBearingsRing && readings < kOdometryRing)) {
    look_for_samples();
    if (has_reading_ && (!has_set_ || reading_.stamp <= set_.stamp)) {
      has_reading_ = false;
      ++readings;
      if (stage_.add(reading_)) pass_on(reading_);
    } else if (has_set_) {
      has_set_ = false;
      ++sets;
      pass_on(set_);
      stage_.add(set_);
    } else {
      return;
    }
  }
}

/// A played source sends samples in the order of their stamps. When a reading is found first, any earlier bearing set
/// is already in the other wire. So the bearings are polled once more after the odometry, and no reading is too late.
void EstimatorTurn::look_for_samples() {
  if (!has_set_) has_set_ = wires_.bearings.pop(set_);
  if (!has_reading_) has_reading_ = wires_.odometry.pop(reading_);
  if (!has_set_ && has_reading_) has_set_ = wires_.bearings.pop(set_);
}

void EstimatorTurn::pass_on(const OdometryReading& reading) {
  if (wires_.taken) {
    taken_.is_odometry = true;
    taken_.odometry = reading;
    wires_.taken->push(taken_);
  }
  if (!wires_.odometry_echo) return;
  OdometryReading echo = reading;
  wires_.odometry_echo->push(echo);
}

void EstimatorTurn::pass_on(const BearingSet& set) {
  if (wires_.taken) {
    taken_.is_odometry = false;
    taken_.bearings = set;
    wires_.taken->push(taken_);
  }
  if (!wires_.bearings_echo) return;
  echo_ = set;
  wires_.bearings_echo->push(echo_);
}

/// Expected bearings serve people, so they are not published for every image of a fast camera.
void EstimatorTurn::look_on(const BearingSet& set, const Estimator& estimator) {
  if (wires_.expected_images && set.stamp == wires_.shown.load(std::memory_order_relaxed)) {
    expected_.stamp = set.stamp;
    estimator.expect(expected_.bearings);
    expected_.in_map = in_map_;
    wires_.expected_images->publish(expected_);
  }
  if (!tells_expectations() || set.stamp < next_expected_) return;
  next_expected_ = set.stamp + kExpectedInterval;
  result_.expected.stamp = set.stamp;
  estimator.expect(result_.expected.bearings);
}

/// Storage that arrives on map_storage is the keeper's request. It still holds the previous map if that was saved to
/// disk, and is empty otherwise. The storage is returned empty when there is no map worth saving.
void EstimatorTurn::hand_over_map() {
  if (!map_->landmarks.empty()) stage_.map_is_kept();
  if (stage_.save_map(*map_)) {
    stage_.map_is_made();
    // The motion is sent before the map, so that the keeper has the motion when the map is on the disk.
    next_way_ = Stamp::min();
    if (wires_.ways) hand_over_way();
  } else {
    map_->clear();
  }
  wires_.maps.publish(map_);
}

/// Storage that arrives on path_storage is the publisher's request. The last path is sent without a request.
void EstimatorTurn::hand_over_path() {
  if (!path_) path_ = std::make_unique<std::vector<PathPose>>();
  if (!stage_.estimator().write_path(*path_)) path_->clear();
  wires_.paths.publish(path_);
}

/// Paced by the stamps of the samples; no clock is read. Before the first odometry nothing is sent, because the motion
/// kept by the previous process is still valid.
void EstimatorTurn::hand_over_way() {
  if (!stage_.has_odometry() || reading_.stamp < next_way_) return;
  next_way_ = reading_.stamp + kHandOverInterval;
  if (!stage_.since_map(ways_.since_map.emplace())) ways_.since_map.reset();
  if (!stage_.since_made_map(ways_.since_made_map.emplace())) ways_.since_made_map.reset();
  wires_.ways->publish(ways_);
}

/// Reports a start that had odometry of an earlier process to continue from.
void EstimatorTurn::tell_of_start() {
  const std::optional<bool> goes_on = stage_.odometry_goes_on();
  if (!goes_on) return;
  told_of_start_ = true;
  DeviceEvent news;
  news.text = *goes_on ? "odometry goes on from before the start, so the robot is where that leads from the saved map"
                       : "odometry does not go on from before the start: the odometer began anew, or what it shows "
                         "cannot follow what was kept";
  wires_.start_news.publish(news);
}

/// Publishes the finding when the trouble has changed, and once more at the end. The last one is sent before the end
/// mark of the estimates, so that the last status has its numbers.
void EstimatorTurn::tell_of_samples(bool over) {
  const SampleTrouble trouble = stage_.samples().trouble();
  const bool is_news = trouble != std::exchange(told_trouble_, trouble);
  if (!is_news && (!over || wires_.estimates_over.is_set())) return;
  finding_ = stage_.samples().finding();
  wires_.findings.publish(finding_);
}

}  // namespace azimuth
