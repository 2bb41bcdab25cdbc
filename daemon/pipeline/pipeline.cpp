#include "daemon/pipeline/pipeline.hpp"

#include <cassert>
#include <utility>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// Longest sleep of a stage with nothing to do: it beats at least this often.
constexpr auto kNap = 100ms;
/// How long an image waits for the estimator before it is painted without what was expected of it.
constexpr auto kPainterPatience = 500ms;

StageSpec spec(const char* name, const StageScheduling& scheduling, const ThreadSettings& threads) {
  return {name, scheduling.fifo_priority, scheduling.cpu, std::chrono::milliseconds(threads.deadline_ms)};
}

}  // namespace

Pipeline::Pipeline(Stages stages, const ThreadSettings& threads, Doorbell& supervisor)
    : supervisor_bell_(supervisor),
      bearings_(estimator_bell_, stages.perception ? &perception_bell_ : &source_bells_[0]),
      stages_(std::move(stages)),
      estimator_(spec("estimator", threads.estimator, threads), estimator_bell_, [this] { estimate(); }),
      publisher_(spec("publisher", threads.publisher, threads), publisher_bell_, [this] { publish(); }) {
  assert(!stages_.sources.empty() && stages_.sources.size() <= kMaxSources);
  for (std::size_t i = 0; i < stages_.sources.size(); ++i) {
    sources_.push_back(std::make_unique<StageThread>(spec(stages_.sources[i]->name(), threads.source, threads),
                                                     source_bells_[i], [this, i] { run_source(i); }));
    flow_.push_back(sources_.back().get());
  }
  if (stages_.perception) {
    perception_.emplace(spec("perception", threads.perception, threads), perception_bell_, [this] { perceive(); });
    flow_.push_back(&*perception_);
  }
  flow_.push_back(&estimator_);
  flow_.push_back(&publisher_);
  if (stages_.perception && stages_.painter) {
    painter_.emplace(StageSpec{.name = "painter", .deadline = std::chrono::milliseconds(threads.deadline_ms)},
                     painter_bell_, [this] { paint(); });
    flow_.push_back(&*painter_);
    stages_.estimator.before_update(
        [this](const BearingSet& set, const Estimator& estimator) { show(set, estimator); });
  }
  if (stages_.recorder) {
    recorder_.emplace(spec("recorder", threads.recorder, threads), recorder_bell_, [this] { record(); });
    flow_.push_back(&*recorder_);
    stages_.publisher.listen([this](std::string_view channel, std::span<const std::byte> message, Stamp utime) {
      publisher_sent_.channel.assign(channel);
      publisher_sent_.data.assign(message.begin(), message.end());
      publisher_sent_.utime = utime;
      sent_.push(publisher_sent_);
    });
  }
  if (stages_.keeper) {
    keeper_.emplace(StageSpec{.name = "keeper", .deadline = std::chrono::milliseconds(threads.deadline_ms)},
                    keeper_bell_, [this] { keep(); });
    flow_.push_back(&*keeper_);
  }
  prepare_storage();
}

void Pipeline::prepare_storage() {
  // Storage goes round between the stages, so every piece of it starts out large enough.
  const auto grow = [](BearingSet& set) { set.bearings.reserve(kTypicalBearings); };
  bearings_.prepare(grow);
  bearings_echo_.prepare(grow);
  taken_.prepare([&](TakenSample& taken) { grow(taken.bearings); });
  for (BearingSet* set : {&perception_set_, &estimator_set_, &estimator_echo_, &publisher_set_,
                          &estimator_taken_.bearings, &recorder_taken_.bearings})
    grow(*set);
  const auto grow_map = [](Estimate& estimate) {
    estimate.landmarks.reserve(kTypicalLandmarks);
    estimate.accepted.reserve(kTypicalLandmarks);
  };
  estimates_.prepare([&](StepResult& result) { grow_map(result.estimate); });
  predictions_.prepare(grow_map);
  for (Estimate* map : {&result_.estimate, &publisher_result_.estimate, &prediction_, &publisher_prediction_})
    grow_map(*map);
}

void Pipeline::run_source(std::size_t i) {
  SourceWires wires{odometry_, perception_ ? nullptr : &bearings_, perception_ ? &frames_ : nullptr, devices_[i],
                    events_[i]};
  if (stages_.sources[i]->turn(source_bells_[i], wires)) return;
  if (sources_over_.exchange(true)) return;
  if (perception_)
    perception_bell_.ring();
  else
    end_of_samples();
}

void Pipeline::end_of_samples() {
  if (!samples_over_.exchange(true)) estimator_bell_.ring();
}

void Pipeline::perceive() {
  perception_bell_.wait(kNap);
  const bool over = sources_over_.load(std::memory_order_acquire);
  // Without room the frame stays where a newer one replaces it: what is lost is the oldest, as when images are slow.
  if (!bearings_.has_room()) return;
  if (frames_.take(perception_frame_)) {
    stages_.perception->observe(perception_frame_, perception_set_);
    if (painter_) show(perception_frame_, perception_set_);
    bearings_.push(perception_set_);
    perception_frame_ = Frame{};  // only now: a played source waits for it
  }
  if (stages_.perception->is_news(PerceptionStage::Clock::now()) || over) {
    perception_news_ = stages_.perception->status();
    perception_status_.publish(perception_news_);
  }
  if (over) end_of_samples();
}

void Pipeline::estimate() {
  estimator_bell_.wait(kNap);
  // Asked before draining: when it is true, every sample is in the wires by now.
  const bool over = samples_over_.load(std::memory_order_acquire);
  // A played source hands odometry over before the bearings it belongs to. Odometry drained after the bearings
  // therefore includes all that was measured before them, and no reading is ever too late.
  drain_odometry();
  drain_bearings();
  drain_odometry();
  if (over) stages_.estimator.finish();
  while (stages_.estimator.advance(result_.estimate)) {
    digest_.add(result_.estimate);
    result_.digest = digest_.value();
    estimates_.publish(result_);
  }
  if (stages_.estimator.look_ahead(prediction_)) predictions_.publish(prediction_);
  if (map_storage_.take(estimator_map_)) hand_over_map();
  if (over && !estimates_over_.exchange(true)) publisher_bell_.ring();
}

/// At most one ring full, so that a turn ends although the source goes on. What was taken goes on to the publisher: it
/// is what a replay needs for the same estimates.
void Pipeline::drain_odometry() {
  for (std::size_t i = 0; i < kOdometryRing && odometry_.pop(estimator_reading_); ++i) {
    if (stages_.estimator.add(estimator_reading_)) pass_on(estimator_reading_);
  }
}

void Pipeline::drain_bearings() {
  for (std::size_t i = 0; i < kBearingsRing && bearings_.pop(estimator_set_); ++i) {
    pass_on(estimator_set_);
    stages_.estimator.add(estimator_set_);
  }
}

void Pipeline::pass_on(const OdometryReading& reading) {
  if (recorder_) {
    estimator_taken_.is_odometry = true;
    estimator_taken_.odometry = reading;
    taken_.push(estimator_taken_);
  }
  if (!stages_.echo_samples) return;
  OdometryReading echo = reading;
  odometry_echo_.push(echo);
}

void Pipeline::pass_on(const BearingSet& set) {
  if (recorder_) {
    estimator_taken_.is_odometry = false;
    estimator_taken_.bearings = set;
    taken_.push(estimator_taken_);
  }
  if (!stages_.echo_samples) return;
  estimator_echo_ = set;
  bearings_echo_.push(estimator_echo_);
}

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
    recorder.message(recorder_sent_.channel, recorder_sent_.data, to_us(recorder_sent_.utime));
  recorder.turn(Recorder::Clock::now());
  report(recorder.status());
}

/// Storage that arrives is the keeper's request. What is not worth keeping goes back empty.
void Pipeline::hand_over_map() {
  if (!stages_.estimator.save_map(*estimator_map_)) estimator_map_->clear();
  maps_.publish(estimator_map_);
}

/// The storage is here, at the estimator's, or on its way: so no map is made while one is being saved.
void Pipeline::keep() {
  keeper_bell_.wait(kNap);
  MapKeeper& keeper = *stages_.keeper;
  if (maps_.take(keeper_map_)) keeper.save(*keeper_map_);
  if (keeper_map_ && keeper.is_due(MapKeeper::Clock::now())) map_storage_.publish(keeper_map_);
  report(keeper.status());
}

/// With all threads at rest, what they own is this one's.
void Pipeline::save_last_map() {
  if (!started_ || saved_last_map_ || !stages_.keeper) return;
  saved_last_map_ = true;
  MapSnapshot map;
  if (stages_.estimator.save_map(map)) stages_.keeper->save(map);
}

void Pipeline::report(const MapKeeperStatus& status) {
  if (status.text == keeper_status_.text && status.trouble == keeper_status_.trouble) return;
  keeper_status_ = {status.text, status.trouble};
  MapStatus news = keeper_status_;
  map_status_.publish(news);
}

/// Only what changed: the publisher need not wake up for the rest.
void Pipeline::report(const RecorderStatus& status) {
  const std::string& text = status.on ? status.file : status.reason;
  if (text == recorder_status_.text && status.lost_events == recorder_status_.losses) return;
  recorder_status_.text = text;
  recorder_status_.losses = status.lost_events;
  RecordStatus news = recorder_status_;
  record_status_.publish(news);
}

void Pipeline::publish() {
  publisher_bell_.wait(kNap);
  const bool over = estimates_over_.load(std::memory_order_acquire);
  Publisher& publisher = stages_.publisher;
  if (estimates_.take(publisher_result_)) publisher.step(publisher_result_);
  if (predictions_.take(publisher_prediction_)) publisher.prediction(publisher_prediction_);
  drain_echoes();
  gather(publisher_status_);
  const auto now = Publisher::Clock::now();
  if (over && !published_all_.load(std::memory_order_relaxed)) {
    publisher.send_last(now, publisher_status_);
    status_.publish(publisher_status_);
    published_all_.store(true, std::memory_order_release);
    supervisor_bell_.ring();
  } else if (publisher.send_due(now, publisher_status_)) {
    status_.publish(publisher_status_);
  }
}

void Pipeline::drain_echoes() {
  for (std::size_t i = 0; i < kOdometryRing && odometry_echo_.pop(publisher_reading_); ++i) {
    stages_.publisher.odometry(publisher_reading_);
  }
  for (std::size_t i = 0; i < kBearingsRing && bearings_echo_.pop(publisher_set_); ++i) {
    stages_.publisher.bearings(publisher_set_);
  }
}

void Pipeline::gather(Status& status) {
  for (std::size_t i = 0; i < sources_.size(); ++i) devices_[i].take(publisher_devices_[i]);
  status.odometer = publisher_devices_[0];
  status.camera = publisher_devices_[1];
  perception_status_.take(publisher_perception_);
  status.perception = publisher_perception_;
  record_status_.take(publisher_record_);
  status.record = publisher_record_;
  map_status_.take(publisher_map_);
  status.map = publisher_map_;
  process_.take(publisher_process_);
  status.process = publisher_process_;
  status.wires = losses();
}

void Pipeline::start() {
  started_ = true;
  if (keeper_) keeper_->start();
  if (recorder_) recorder_->start();
  if (painter_) painter_->start();
  publisher_.start();
  estimator_.start();
  if (perception_) perception_->start();
  for (const auto& source : sources_) source->start();
}

void Pipeline::stop() {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    sources_[i]->stop();
    if (!closed_) stages_.sources[i]->close();
  }
  closed_ = true;
  sources_over_.store(true, std::memory_order_release);
  if (perception_) perception_->stop();
  samples_over_.store(true, std::memory_order_release);
  estimator_.stop();
  estimates_over_.store(true, std::memory_order_release);
  publisher_.stop();
  if (painter_) painter_->stop();
  if (recorder_) recorder_->stop();
  if (keeper_) keeper_->stop();
  save_last_map();
}

WireLosses Pipeline::losses() const {
  return {.odometry_refused = odometry_.refused(),
          .bearings_refused = bearings_.refused(),
          .frames_replaced = frames_.replaced(),
          .estimates_replaced = estimates_.replaced(),
          .echoes_refused = odometry_echo_.refused() + bearings_echo_.refused(),
          .records_refused = taken_.refused() + sent_.refused()};
}

bool Pipeline::take_event(DeviceEvent& into) {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (!events_[i].pop(into)) continue;
    into.device = stages_.sources[i]->name();
    return true;
  }
  return false;
}

const StageThread* Pipeline::first_late(std::chrono::steady_clock::time_point now) const {
  for (const StageThread* stage : flow_) {
    const bool waits_for_disk =
        (recorder_ && stage == &*recorder_) || (painter_ && stage == &*painter_) || (keeper_ && stage == &*keeper_);
    if (!waits_for_disk && stage->late(now)) return stage;
  }
  return nullptr;
}

}  // namespace azimuth
