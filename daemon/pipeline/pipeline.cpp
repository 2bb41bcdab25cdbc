#include "daemon/pipeline/pipeline.hpp"

#include <algorithm>
#include <cassert>
#include <opencv2/core/utility.hpp>
#include <utility>

namespace azimuth {
namespace {

/// Nice value of the frame recorder. Encoding images takes time that all other threads use better.
constexpr int kBackgroundNice = 10;

}  // namespace

Pipeline::Pipeline(Stages stages, const ThreadSettings& threads, Doorbell& supervisor)
    : bells_(supervisor),
      wires_(bells_, stages.perception.has_value()),
      stages_(std::move(stages)),
      estimator_(std::move(stages_.estimator), estimator_wires(), bells_.estimator),
      publisher_(
          std::move(stages_.publisher), publisher_wires(), bells_.publisher, [this] { return wires_.losses(); },
          std::move(stages_.picture_trouble)) {
  assert(!stages_.sources.empty() && stages_.sources.size() <= kMaxSources);
  wires_.prepare();
  for (std::size_t i = 0; i < stages_.sources.size(); ++i) sources_.push_back(source_turn(i));
  if (stages_.perception) {
    perception_.emplace(*stages_.perception,
                        PerceptionTurn::Wires{.frames = wires_.frames,
                                              .bearings = wires_.bearings,
                                              .status = wires_.parts.perception,
                                              .sources_over = wires_.over.sources,
                                              .samples_over = wires_.over.samples,
                                              .seen_images = paints() ? &wires_.pictures.seen : nullptr,
                                              .shown = wires_.pictures.shown,
                                              .kept_images = records_images() ? &wires_.record.images : nullptr},
                        bells_.perception, paints() ? stages_.painter->interval() : std::chrono::nanoseconds(0),
                        records_images() ? stages_.frame_recorder->rate_hz() : 0.0);
  }
  if (paints())
    painter_.emplace(*stages_.painter, PainterTurn::Wires{wires_.pictures.seen, wires_.pictures.expected},
                     bells_.painter);
  if (stages_.recorder) {
    recorder_.emplace(*stages_.recorder,
                      RecorderTurn::Wires{.taken = wires_.record.taken,
                                          .sent = wires_.record.sent,
                                          .status = wires_.parts.record,
                                          .session = records_images() ? &wires_.record.session : nullptr},
                      bells_.recorder);
  }
  if (records_images()) {
    stages_.frame_recorder->begin(stages_.recorder->session());
    frame_recorder_.emplace(*stages_.frame_recorder,
                            FrameRecorderTurn::Wires{.images = wires_.record.images,
                                                     .session = wires_.record.session,
                                                     .poses_out = wires_.record.poses_out,
                                                     .status = wires_.parts.frame_record},
                            bells_.frame_recorder);
  }
  if (stages_.keeper) {
    keeper_.emplace(*stages_.keeper,
                    KeeperTurn::Wires{.maps = wires_.keep.maps,
                                      .map_storage = wires_.keep.storage,
                                      .memories = wires_.keep.memories,
                                      .ways = wires_.keep.ways,
                                      .status = wires_.parts.map},
                    bells_.keeper);
  }
  table_ = table(threads);
  for (const Thread& row : table_) {
    threads_.push_back(std::make_unique<StageThread>(row.spec, row.bell, row.turn));
    flow_.push_back(threads_.back().get());
  }
}

/// The rows are in the order in which samples pass through the threads.
std::vector<Pipeline::Thread> Pipeline::table(const ThreadSettings& threads) {
  const auto spec = [&](const char* name, const StageScheduling& scheduling) {
    return StageSpec{name, scheduling.fifo_priority, scheduling.cpu, std::chrono::milliseconds(threads.deadline_ms)};
  };
  const StageScheduling normal;
  std::vector<Thread> table;
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    SourceTurn& turn = sources_[i];
    const bool last = i + 1 == sources_.size();
    table.push_back({spec(turn.source().name(), threads.source), true, bells_.sources[i], [&turn] { turn(); },
                     [this, &turn, last] {
                       turn.source().close();
                       if (last) wires_.over.sources.set();
                     }});
  }
  if (perception_)
    table.push_back({spec("perception", threads.perception), true, bells_.perception, [this] { (*perception_)(); }});
  table.back().when_stopped = [this, before = table.back().when_stopped] {
    before();
    wires_.over.samples.set();
  };
  table.push_back({spec("estimator", threads.estimator), true, bells_.estimator, [this] { estimator_(); },
                   [this] { wires_.over.estimates.set(); }});
  table.push_back({spec("publisher", threads.publisher), true, bells_.publisher, [this] { publisher_(); }});
  if (painter_) table.push_back({spec("painter", normal), false, bells_.painter, [this] { (*painter_)(); }});
  if (recorder_)
    table.push_back({spec("recorder", threads.recorder), false, bells_.recorder, [this] { (*recorder_)(); }});
  if (frame_recorder_) {
    StageSpec of_images = spec("frame_recorder", normal);
    of_images.nice = kBackgroundNice;
    table.push_back({of_images, false, bells_.frame_recorder, [this] { (*frame_recorder_)(); }});
  }
  if (keeper_) table.push_back({spec("keeper", normal), false, bells_.keeper, [this] { (*keeper_)(); }});
  return table;
}

SourceTurn Pipeline::source_turn(std::size_t i) {
  const bool sees = stages_.perception.has_value();
  return {*stages_.sources[i],
          {.samples = {wires_.odometry, sees ? nullptr : &wires_.bearings, sees ? &wires_.frames : nullptr,
                       wires_.devices[i], wires_.events[i]},
           .memories = stages_.keeper && i == 0 ? &wires_.keep.memories : nullptr,
           .over = sees ? wires_.over.sources : wires_.over.samples},
          bells_.sources[i]};
}

EstimatorTurn::Wires Pipeline::estimator_wires() {
  return {.odometry = wires_.odometry,
          .bearings = wires_.bearings,
          .estimates = wires_.estimates,
          .predictions = wires_.predictions,
          .findings = wires_.findings,
          .start_news = wires_.start_news,
          .samples_over = wires_.over.samples,
          .estimates_over = wires_.over.estimates,
          .odometry_echo = stages_.echo_samples ? &wires_.odometry_echo : nullptr,
          .bearings_echo = stages_.echo_samples ? &wires_.bearings_echo : nullptr,
          .taken = stages_.recorder ? &wires_.record.taken : nullptr,
          .expected_images = paints() ? &wires_.pictures.expected : nullptr,
          .shown = wires_.pictures.shown,
          .map_storage = wires_.keep.storage,
          .maps = wires_.keep.maps,
          .ways = stages_.keeper ? &wires_.keep.ways : nullptr,
          .path_storage = wires_.path.storage,
          .paths = wires_.path.paths};
}

PublisherTurn::Wires Pipeline::publisher_wires() {
  return {.estimates = wires_.estimates,
          .predictions = wires_.predictions,
          .odometry_echo = wires_.odometry_echo,
          .bearings_echo = wires_.bearings_echo,
          .devices = wires_.devices,
          .perception = wires_.parts.perception,
          .record = wires_.parts.record,
          .frame_record = wires_.parts.frame_record,
          .map = wires_.parts.map,
          .process = wires_.parts.process,
          .findings = wires_.findings,
          .sent = stages_.recorder ? &wires_.record.sent : nullptr,
          .poses_out = records_images() ? &wires_.record.poses_out : nullptr,
          .path_storage = wires_.path.storage,
          .paths = wires_.path.paths,
          .statuses = wires_.statuses,
          .estimates_over = wires_.over.estimates,
          .published_all = wires_.over.everything};
}

void Pipeline::start() {
  // OpenCV would run a part of a stage's work on threads of its own, which do not have the stage's priority.
  cv::setNumThreads(0);
  started_ = true;
  std::for_each(threads_.rbegin(), threads_.rend(), [](const auto& thread) { thread->start(); });
}

void Pipeline::stop() {
  if (std::exchange(stopped_, true)) return;
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    threads_[i]->stop();
    table_[i].when_stopped();
  }
  // All threads are at rest, so this thread may touch their objects.
  if (started_ && keeper_) keeper_->save_last(estimator_.stage(), *stages_.sources.front());
}

bool Pipeline::take_event(DeviceEvent& into) {
  if (wires_.start_news.take(into)) {
    into.device = stages_.sources.front()->name();
    return true;
  }
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (!wires_.events[i].pop(into)) continue;
    into.device = stages_.sources[i]->name();
    return true;
  }
  return false;
}

const StageThread* Pipeline::first_late(std::chrono::steady_clock::time_point now) const {
  for (std::size_t i = 0; i < threads_.size(); ++i)
    if (table_[i].is_watched && threads_[i]->late(now)) return threads_[i].get();
  return nullptr;
}

}  // namespace azimuth
