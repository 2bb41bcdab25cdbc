#include "daemon/pipeline/pipeline.hpp"

#include <utility>

namespace azimuth {
namespace {

using namespace std::chrono_literals;

/// Longest sleep of a stage with nothing to do: it beats at least this often.
constexpr auto kNap = 100ms;

StageSpec spec(const char* name, const StageScheduling& scheduling, const ThreadSettings& threads) {
  return {name, scheduling.fifo_priority, scheduling.cpu, std::chrono::milliseconds(threads.deadline_ms)};
}

}  // namespace

Pipeline::Pipeline(Stages stages, const ThreadSettings& threads, Doorbell& supervisor)
    : supervisor_bell_(supervisor),
      stages_(std::move(stages)),
      source_(spec("source", threads.source, threads), source_bell_, [this] { play(); }),
      estimator_(spec("estimator", threads.estimator, threads), estimator_bell_, [this] { estimate(); }),
      publisher_(spec("publisher", threads.publisher, threads), publisher_bell_, [this] { publish(); }) {
  // Storage goes round between the stages, so every piece of it starts out large enough.
  const auto grow = [](BearingSet& set) { set.bearings.reserve(kTypicalBearings); };
  bearings_.prepare(grow);
  bearings_echo_.prepare(grow);
  for (BearingSet* set : {&source_set_, &source_echo_, &estimator_set_, &publisher_set_}) grow(*set);
  const auto grow_map = [](Estimate& estimate) { estimate.landmarks.reserve(kTypicalLandmarks); };
  estimates_.prepare([&](StepResult& result) { grow_map(result.estimate); });
  predictions_.prepare(grow_map);
  for (Estimate* map : {&result_.estimate, &publisher_result_.estimate, &prediction_, &publisher_prediction_})
    grow_map(*map);
}

void Pipeline::play() {
  RunPlayer& source = stages_.source;
  if (source.over()) {
    if (!samples_over_.exchange(true)) estimator_bell_.ring();
    return source_bell_.wait(kNap);
  }
  const auto due_in = source.due_in(RunPlayer::Clock::now(), kNap);
  if (due_in > 0ns) return source_bell_.wait(due_in);
  if (!hand_over(source.peek())) return source_bell_.wait(kNap);
  source.advance();
}

/// A recording can wait for the estimator, but not for the network. False: no room yet; the bell will ring.
bool Pipeline::hand_over(const RunPlayer::Sample& sample) {
  if (sample.odometry) {
    if (!odometry_.has_room()) return false;
    OdometryReading reading = *sample.odometry, echo = reading;
    odometry_.push(reading);
    if (stages_.echo_samples) odometry_echo_.push(echo);
  } else {
    if (!bearings_.has_room()) return false;
    source_set_ = *sample.bearings;
    bearings_.push(source_set_);
    if (stages_.echo_samples) {
      source_echo_ = *sample.bearings;
      bearings_echo_.push(source_echo_);
    }
  }
  return true;
}

void Pipeline::estimate() {
  estimator_bell_.wait(kNap);
  // Asked before draining: when it is true, every sample is in the wires by now.
  const bool over = samples_over_.load(std::memory_order_acquire);
  // The source hands odometry over before the bearings it belongs to. Odometry drained after the bearings therefore
  // includes all that was measured before them, and the steps depend on the samples alone, not on when they came.
  drain_odometry();
  for (std::size_t i = 0; i < kBearingsRing && bearings_.pop(estimator_set_); ++i) {
    stages_.estimator.add(estimator_set_);
  }
  drain_odometry();
  if (over) stages_.estimator.finish();
  while (stages_.estimator.advance(result_.estimate)) {
    digest_.add(result_.estimate);
    result_.digest = digest_.value();
    estimates_.publish(result_);
  }
  if (stages_.estimator.look_ahead(prediction_)) predictions_.publish(prediction_);
  if (over && !estimates_over_.exchange(true)) publisher_bell_.ring();
}

/// At most one ring full, so that a turn ends although the source goes on.
void Pipeline::drain_odometry() {
  for (std::size_t i = 0; i < kOdometryRing && odometry_.pop(estimator_reading_); ++i) {
    stages_.estimator.add(estimator_reading_);
  }
}

void Pipeline::publish() {
  publisher_bell_.wait(kNap);
  const bool over = estimates_over_.load(std::memory_order_acquire);
  Publisher& publisher = stages_.publisher;
  if (estimates_.take(publisher_result_)) publisher.step(publisher_result_);
  if (predictions_.take(publisher_prediction_)) publisher.prediction(publisher_prediction_);
  for (std::size_t i = 0; i < kOdometryRing && odometry_echo_.pop(publisher_reading_); ++i) {
    publisher.odometry(publisher_reading_);
  }
  for (std::size_t i = 0; i < kBearingsRing && bearings_echo_.pop(publisher_set_); ++i) {
    publisher.bearings(publisher_set_);
  }
  const auto now = Publisher::Clock::now();
  if (over && !published_all_.load(std::memory_order_relaxed)) {
    publisher.send_last(now, losses(), publisher_status_);
    status_.publish(publisher_status_);
    published_all_.store(true, std::memory_order_release);
    supervisor_bell_.ring();
  } else if (publisher.send_due(now, losses(), publisher_status_)) {
    status_.publish(publisher_status_);
  }
}

void Pipeline::start() {
  publisher_.start();
  estimator_.start();
  source_.start();
}

void Pipeline::stop() {
  source_.stop();
  samples_over_.store(true, std::memory_order_release);
  estimator_.stop();
  estimates_over_.store(true, std::memory_order_release);
  publisher_.stop();
}

WireLosses Pipeline::losses() const {
  return {odometry_.refused(), bearings_.refused(), estimates_.replaced(),
          odometry_echo_.refused() + bearings_echo_.refused()};
}

const StageThread* Pipeline::first_late(std::chrono::steady_clock::time_point now) const {
  for (const StageThread* stage : flow_) {
    if (stage->late(now)) return stage;
  }
  return nullptr;
}

}  // namespace azimuth
