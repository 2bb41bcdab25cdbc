#include "daemon/pipeline/pipeline.hpp"

#include <cassert>
#include <utility>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// Longest sleep of a stage with nothing to do: it beats at least this often.
constexpr auto kNap = 100ms;
/// How often what the next start goes on with is handed to the keeper.
constexpr auto kHandOverInterval = 250ms;
/// Encoding images takes time that everything else can use better.
constexpr int kBackgroundNice = 10;

StageSpec spec(const char* name, const StageScheduling& scheduling, const ThreadSettings& threads) {
  return {name, scheduling.fifo_priority, scheduling.cpu, std::chrono::milliseconds(threads.deadline_ms)};
}

}  // namespace

Pipeline::Pipeline(Stages stages, const ThreadSettings& threads, Doorbell& supervisor)
    : supervisor_bell_(supervisor),
      bearings_(estimator_bell_, stages.perception ? &perception_bell_ : &source_bells_[0]),
      stages_(std::move(stages)),
      frame_pace_(stages_.frame_recorder ? stages_.frame_recorder->rate_hz() : 0.0),
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
    stages_.publisher.listen([this](std::string_view channel, std::span<const std::byte> message, Stamp) {
      publisher_sent_.channel.assign(channel);
      publisher_sent_.data.assign(message.begin(), message.end());
      sent_.push(publisher_sent_);
    });
  }
  if (stages_.perception && stages_.recorder && stages_.frame_recorder) {
    frame_recorder_.emplace(StageSpec{.name = "frame_recorder",
                                      .deadline = std::chrono::milliseconds(threads.deadline_ms),
                                      .nice = kBackgroundNice},
                            frame_recorder_bell_, [this] { record_images(); });
    flow_.push_back(&*frame_recorder_);
    stages_.frame_recorder->begin(stages_.recorder->session());
    session_told_ = !stages_.recorder->session().empty();
  }
  if (stages_.keeper) {
    keeper_.emplace(StageSpec{.name = "keeper", .deadline = std::chrono::milliseconds(threads.deadline_ms)},
                    keeper_bell_, [this] { keep(); });
    flow_.push_back(&*keeper_);
  }
  publisher_status_.picture = stages_.picture_trouble;
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
  const bool goes_on = stages_.sources[i]->turn(source_bells_[i], wires);
  if (keeper_ && i == 0) hand_over_memory();
  if (goes_on) return;
  if (sources_over_.exchange(true)) return;
  if (perception_)
    perception_bell_.ring();
  else
    end_of_samples();
}

/// The odometer's, which is the first source.
void Pipeline::hand_over_memory() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_memory_ || !stages_.sources.front()->remember(source_memory_)) return;
  next_memory_ = now + kHandOverInterval;
  memories_.publish(source_memory_);
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
    if (frame_recorder_) keep(perception_frame_);
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
  drain_samples(over);
  if (over) stages_.estimator.finish();
  while (stages_.estimator.advance(result_.estimate)) {
    digest_.add(result_.estimate);
    result_.digest = digest_.value();
    estimates_.publish(result_);
  }
  if (stages_.estimator.look_ahead(prediction_)) predictions_.publish(prediction_);
  if (map_storage_.take(estimator_map_)) hand_over_map();
  if (keeper_) hand_over_way();
  if (!told_of_start_) tell_of_start();
  tell_of_samples(over);
  if (over && !estimates_over_.exchange(true)) publisher_bell_.ring();
}

/// When it has changed, and with its last numbers at the end: before it is said that no estimate will come, so that the
/// last status has them.
void Pipeline::tell_of_samples(bool over) {
  const SampleTrouble trouble = stages_.estimator.samples().trouble();
  const bool is_news = trouble != std::exchange(told_trouble_, trouble);
  if (!is_news && (!over || estimates_over_.load(std::memory_order_relaxed))) return;
  estimator_samples_ = stages_.estimator.samples().finding();
  samples_.publish(estimator_samples_);
}

/// Of a start that had odometry to go on with.
void Pipeline::tell_of_start() {
  const std::optional<bool> goes_on = stages_.estimator.odometry_goes_on();
  if (!goes_on) return;
  told_of_start_ = true;
  DeviceEvent news;
  news.text = *goes_on ? "odometry goes on from before the start, so the robot is where that leads from the saved map"
                       : "odometry does not go on from before the start: the odometer began anew, or what it shows "
                         "cannot follow what was kept";
  start_news_.publish(news);
}

/// In the order of stamps, as a replay gives them and the log is to have them. While sources go on, a turn ends with
/// the rings' worth of one kind. What was taken goes on to the publisher: it is what a replay needs for the same
/// estimates.
void Pipeline::drain_samples(bool over) {
  std::size_t sets = 0, readings = 0;
  while (over || (sets < kBearingsRing && readings < kOdometryRing)) {
    look_for_samples();
    if (has_reading_ && (!has_set_ || estimator_reading_.stamp <= estimator_set_.stamp)) {
      has_reading_ = false;
      ++readings;
      if (stages_.estimator.add(estimator_reading_)) pass_on(estimator_reading_);
    } else if (has_set_) {
      has_set_ = false;
      ++sets;
      pass_on(estimator_set_);
      stages_.estimator.add(estimator_set_);
    } else {
      return;
    }
  }
}

/// A played source hands samples over in the order of their stamps. Whatever belongs before the one that was found
/// first is in the other wire by then, so that is looked at once more: no reading is ever too late.
void Pipeline::look_for_samples() {
  if (!has_set_) has_set_ = bearings_.pop(estimator_set_);
  if (!has_reading_) has_reading_ = odometry_.pop(estimator_reading_);
  if (!has_set_ && has_reading_) has_set_ = bearings_.pop(estimator_set_);
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

/// Storage that arrives is the keeper's request. What is not worth keeping goes back empty.
void Pipeline::hand_over_map() {
  if (stages_.estimator.save_map(*estimator_map_)) {
    stages_.estimator.map_is_kept();
    next_way_ = Stamp::min();  // with the map, so that it is kept as soon as that is on the disk
    hand_over_way();
  } else {
    estimator_map_->clear();
  }
  maps_.publish(estimator_map_);
}

/// By the stamps of what was taken: no clock is asked.
void Pipeline::hand_over_way() {
  if (estimator_reading_.stamp < next_way_) return;
  next_way_ = estimator_reading_.stamp + kHandOverInterval;
  if (!stages_.estimator.since_map(estimator_way_.emplace())) estimator_way_.reset();
  ways_.publish(estimator_way_);
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
  frame_record_status_.take(publisher_frame_record_);
  status.frame_record = publisher_frame_record_;
  map_status_.take(publisher_map_);
  status.map = publisher_map_;
  process_.take(publisher_process_);
  status.process = publisher_process_;
  samples_.take(publisher_samples_);
  status.samples = publisher_samples_;
  status.wires = losses();
}

void Pipeline::start() {
  started_ = true;
  if (keeper_) keeper_->start();
  if (recorder_) recorder_->start();
  if (frame_recorder_) frame_recorder_->start();
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
  if (frame_recorder_) frame_recorder_->stop();
  if (keeper_) keeper_->stop();
  save_last_map();
}

WireLosses Pipeline::losses() const {
  return {.odometry_refused = odometry_.refused(),
          .bearings_refused = bearings_.refused(),
          .frames_replaced = frames_.replaced(),
          .estimates_replaced = estimates_.replaced(),
          .echoes_refused = odometry_echo_.refused() + bearings_echo_.refused(),
          .records_refused = taken_.refused() + sent_.refused() + kept_images_.refused()};
}

bool Pipeline::take_event(DeviceEvent& into) {
  if (start_news_.take(into)) {
    into.device = stages_.sources.front()->name();
    return true;
  }
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (!events_[i].pop(into)) continue;
    into.device = stages_.sources[i]->name();
    return true;
  }
  return false;
}

const StageThread* Pipeline::first_late(std::chrono::steady_clock::time_point now) const {
  for (const StageThread* stage : flow_) {
    const auto is = [&](const std::optional<StageThread>& thread) { return thread && stage == &*thread; };
    const bool waits_for_disk = is(recorder_) || is(frame_recorder_) || is(painter_) || is(keeper_);
    if (!waits_for_disk && stage->late(now)) return stage;
  }
  return nullptr;
}

}  // namespace azimuth
