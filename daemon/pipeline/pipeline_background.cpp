// What the pipeline does for people and for later, on threads that nobody waits for: painting, recording, keeping maps.

#include "daemon/pipeline/pipeline.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// Longest sleep of a stage with nothing to do: it beats at least this often.
constexpr auto kNap = 100ms;
/// How long an image waits for the estimator before it is painted without what was expected of it.
constexpr auto kPainterPatience = 500ms;

}  // namespace

/// Before the bearings go to the estimator, which is to say what it expected of this very image.
void Pipeline::show(const Frame& frame, const BearingSet& seen) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_picture_) return;
  next_picture_ = now + stages_.painter->interval();
  perception_image_.format = frame.format();
  perception_image_.bytes.assign(frame.bytes().begin(), frame.bytes().end());
  perception_image_.seen = seen;
  shown_.store(seen.stamp, std::memory_order_relaxed);  // the bearings' wire orders it
  seen_images_.publish(perception_image_);
}

void Pipeline::show(const BearingSet& set, const Estimator& estimator) {
  if (set.stamp != shown_.load(std::memory_order_relaxed)) return;
  estimator_expected_.stamp = set.stamp;
  estimator.expect(estimator_expected_.bearings);
  expected_images_.publish(estimator_expected_);
}

/// What the estimator never comes to, for want of odometry, is painted as it was seen.
void Pipeline::paint() {
  painter_bell_.wait(kNap);
  const auto now = std::chrono::steady_clock::now();
  if (seen_images_.take(painter_image_)) {
    painter_has_image_ = true;
    painter_waits_until_ = now + kPainterPatience;
  }
  expected_images_.take(painter_expected_);
  if (!painter_has_image_) return;
  const bool belong_together = painter_expected_.stamp == painter_image_.seen.stamp;
  if (!belong_together && now < painter_waits_until_) return;
  if (!belong_together) painter_expected_.bearings.clear();
  stages_.painter->paint(painter_image_, painter_expected_);
  painter_has_image_ = false;
}

/// After its bearings have gone on, which are in a hurry.
void Pipeline::keep(const Frame& frame) {
  if (!frame_pace_.takes(frame.stamp)) return;
  if (!kept_images_.has_room()) return kept_images_.refuse();
  perception_kept_.stamp = frame.stamp;
  perception_kept_.format = frame.format();
  perception_kept_.bytes.assign(frame.bytes().begin(), frame.bytes().end());
  kept_images_.push(perception_kept_);
}

void Pipeline::record() {
  recorder_bell_.wait(kNap);
  Recorder& recorder = *stages_.recorder;
  for (std::size_t i = 0; i < kTakenRing && taken_.pop(recorder_taken_); ++i) {
    if (recorder_taken_.is_odometry)
      recorder.odometry(recorder_taken_.odometry);
    else
      recorder.bearings(recorder_taken_.bearings);
  }
  for (std::size_t i = 0; i < kSentRing && sent_.pop(recorder_sent_); ++i)
    recorder.message(recorder_sent_.channel, recorder_sent_.data);
  recorder.turn(Recorder::Clock::now());
  report(recorder.status(), recorder_status_, record_status_);
  if (frame_recorder_) tell_session();
}

/// Of a session that could not be begun at once, the disk being in trouble.
void Pipeline::tell_session() {
  if (session_told_ || stages_.recorder->session().empty()) return;
  session_told_ = true;
  std::string session = stages_.recorder->session();
  session_.publish(session);
}

void Pipeline::record_images() {
  frame_recorder_bell_.wait(kNap);
  FrameRecorder& recorder = *stages_.frame_recorder;
  if (session_.take(frame_recorder_session_)) recorder.begin(frame_recorder_session_);
  for (std::size_t i = 0; i < kImagesRing && kept_images_.pop(frame_recorder_kept_); ++i)
    recorder.image(frame_recorder_kept_);
  recorder.turn(FrameRecorder::Clock::now());
  report(recorder.status(), frame_recorder_status_, frame_record_status_);
}

/// The storage is here, at the estimator's, or on its way: so no map is made while one is being saved.
void Pipeline::keep() {
  keeper_bell_.wait(kNap);
  MapKeeper& keeper = *stages_.keeper;
  if (maps_.take(keeper_map_)) keeper.save(*keeper_map_);
  if (OdometryKeeper* const odometry = keeper.odometry()) {
    const bool remembers = memories_.take(keeper_memory_), went = ways_.take(keeper_way_);
    if (remembers) odometry->odometer_is(keeper_memory_);
    if (went) odometry->robot_went(keeper_way_);
    if (remembers || went) odometry->write();
  }
  if (keeper_map_ && keeper.is_due(MapKeeper::Clock::now())) map_storage_.publish(keeper_map_);
  report(keeper.status());
}

/// With all threads at rest, what they own is this one's.
void Pipeline::save_last_map() {
  if (!started_ || saved_last_map_ || !stages_.keeper) return;
  saved_last_map_ = true;
  MapSnapshot map;
  if (stages_.estimator.save_map(map)) {
    stages_.estimator.map_is_kept();
    stages_.keeper->save(map);
  }
  if (stages_.keeper->odometry()) leave_odometry();
}

void Pipeline::leave_odometry() {
  OdometryKeeper& odometry = *stages_.keeper->odometry();
  if (!stages_.sources.front()->remember(source_memory_)) return odometry.forget();
  if (!stages_.estimator.since_map(estimator_way_.emplace())) estimator_way_.reset();
  odometry.odometer_is(source_memory_);
  odometry.robot_went(estimator_way_);
  odometry.write();
}

void Pipeline::report(const MapKeeperStatus& status) {
  if (status.text == keeper_status_.text && status.trouble == keeper_status_.trouble) return;
  keeper_status_ = {status.text, status.trouble};
  MapStatus news = keeper_status_;
  map_status_.publish(news);
}

/// Only what changed: the publisher need not wake up for the rest.
void Pipeline::report(const RecorderStatus& status, RecordStatus& last, Newest<RecordStatus>& wire) {
  const std::string& text = status.on ? status.file : status.reason;
  if (text == last.text && status.lost_events == last.losses) return;
  last.text = text;
  last.losses = status.lost_events;
  RecordStatus news = last;
  wire.publish(news);
}

}  // namespace azimuth
