#include "slam/hindsight/late_mapper.hpp"

#include <utility>

namespace azimuth {
namespace {

// Images farther apart than this are processed as they arrive.
constexpr double kFarApart_s = 0.3;
// Time from the newest image of a batch to the image that waits for the batch's results.
constexpr double kLate_s = 0.2;

void add(const UpdateOutcome& more, UpdateOutcome& to) {
  to.used = to.used || more.used;
  to.created += more.created;
  to.deleted += more.deleted;
  to.thinned += more.thinned;
  to.ambiguous += more.ambiguous;
  to.recovered += more.recovered;
}

}  // namespace

LateMapper::LateMapper(std::unique_ptr<Mapper> mapper, std::unique_ptr<TaskRunner> runner)
    : mapper_(std::move(mapper)), runner_(std::move(runner)) {
  learn(known_);
}

bool LateMapper::remember(const MapSnapshot& map, const std::optional<Eigen::Matrix3d>& moved) {
  const bool remembered = mapper_->remember(map, moved);
  learn(known_);
  return remembered;
}

void LateMapper::predict(const Motion& motion) { append(since_waiting_, motion); }

UpdateOutcome LateMapper::update(const BearingSet& set) {
  heard_.clear();
  waiting_.push_back({since_waiting_, set});
  after_known_.push_back(since_waiting_);
  since_waiting_ = {};
  const bool far_apart = !last_image_ || to_seconds(set.stamp - *last_image_) >= kFarApart_s;
  last_image_ = set.stamp;

  UpdateOutcome heard;
  if (begun_ && (far_apart || to_seconds(set.stamp - *begun_) >= kLate_s)) {
    adopt();
    add(known_.heard, heard);
  }
  if (begun_) return heard;
  begun_ = set.stamp;
  look_at_waiting();
  if (!far_apart) return heard;
  adopt();
  add(known_.heard, heard);
  return heard;
}

void LateMapper::look_at_waiting() {
  under_way_ = std::exchange(waiting_, {});
  runner_->begin([this] {
    next_.heard = {};
    next_.bearings.clear();
    for (const Waiting& image : under_way_) {
      mapper_->predict(image.motion);
      add(mapper_->update(image.set), next_.heard);
      next_.bearings.insert(next_.bearings.end(), mapper_->heard().begin(), mapper_->heard().end());
    }
    learn(next_);
  });
}

/// Waits for the running batch and takes over its results.
void LateMapper::adopt() {
  runner_->finish();
  begun_.reset();
  std::swap(known_, next_);
  for (UsedBearing& bearing : known_.bearings) bearing.of_last_image = under_way_.size() == after_known_.size();
  heard_.insert(heard_.end(), known_.bearings.begin(), known_.bearings.end());
  after_known_.erase(after_known_.begin(), after_known_.begin() + static_cast<std::ptrdiff_t>(under_way_.size()));
}

void LateMapper::look_at_all() {
  if (begun_) adopt();
  if (waiting_.empty()) return;
  look_at_waiting();
  adopt();
}

void LateMapper::place(const PoseGaussian& robot) {
  look_at_all();
  mapper_->place(robot);
  since_waiting_ = {};
  learn(known_);
  heard_.clear();
}

/// Processes all waiting images first.
void LateMapper::conclude() {
  look_at_all();
  mapper_->conclude();
  learn(known_);
}

void LateMapper::learn(Known& known) const {
  known.landmarks.assign(mapper_->landmarks().begin(), mapper_->landmarks().end());
  known.next_id = mapper_->next_id();
  known.smoother = mapper_->smoother();
  known.numbers = mapper_->numbers();
  known.pose = mapper_->pose();
  known.anchor = mapper_->anchor();
  known.since_anchor = mapper_->since_anchor();
  known.doubt = mapper_->doubt();
  known.scene = mapper_->scene();
  known.rig = mapper_->rig();
  known.calibration = mapper_->calibration();
  known.calibration_sigma = mapper_->calibration_sigma();
}

PoseGaussian LateMapper::pose() const {
  PoseGaussian pose = known_.pose;
  for (const Motion& motion : after_known_) pose = moved(pose, motion);
  return pose;
}

Motion LateMapper::since_anchor() const {
  Motion since = known_.since_anchor;
  for (const Motion& motion : after_known_) append(since, motion);
  return since;
}

PoseGaussian LateMapper::past(PoseNumber number) const {
  runner_->finish();
  return mapper_->past(number);
}

}  // namespace azimuth
