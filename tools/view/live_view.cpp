#include "tools/view/live_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "settings/rig.hpp"
#include "tools/view/message_json.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::json;
using namespace std::chrono_literals;

constexpr auto kPoseInterval = 33ms, kTruthInterval = 33ms;
constexpr auto kSilentAfter = 1500ms, kTellSilenceEvery = 1000ms;
/// Older by more than this is no late step, but a recording that began again.
constexpr std::int64_t kBeganAgain_us = 1'000'000;
/// A stamp farther from the wall clock is of another clock, such as a recording's.
constexpr double kSameClock_s = 10.0;
/// Below, a robot stands.
constexpr double kMoved_m = 1e-4, kTurned_rad = 1e-4, kLongestStep_s = 2.0;

TrailPoint trail_point(double t_s, const pose_cov_t& pose) {
  return {.t_s = t_s,
          .T_map_body = {pose.x_m, pose.y_m, pose.heading_rad},
          .T_odom_body = {pose.odom_x_m, pose.odom_y_m, pose.odom_heading_rad},
          .sigma_m = static_cast<float>(std::sqrt(std::max(0.0, pose.covariance[0] + pose.covariance[4]))),
          .sigma_heading_rad = static_cast<float>(std::sqrt(std::max(0.0, pose.covariance[8]))),
          .health = static_cast<std::uint8_t>(pose.health)};
}

bool moved(const pose_cov_t& from, const pose_cov_t& to) {
  return std::hypot(to.odom_x_m - from.odom_x_m, to.odom_y_m - from.odom_y_m) > kMoved_m ||
         std::abs(to.odom_heading_rad - from.odom_heading_rad) > kTurned_rad;
}

}  // namespace

LiveView::LiveView(std::string version, std::string source, Lookers& lookers, Clock::time_point now,
                   const ViewLimits& limits)
    : version_(std::move(version)),
      source_(std::move(source)),
      lookers_(&lookers),
      limits_(limits),
      since_(now),
      heard_(now),
      trail_(limits.trail_points),
      truth_(limits.trail_points),
      history_(limits.landmarks),
      bearings_(limits.bearings),
      pose_pace_{kPoseInterval},
      truth_pace_{kTruthInterval},
      counted_since_(now) {}

double LiveView::t_s(std::int64_t utime_us) const {
  return 1e-6 * static_cast<double>(utime_us - epoch_us_.value_or(utime_us));
}

void LiveView::hear(const Heard& heard) {
  heard_ = heard.at;
  told_silence_.reset();
  newest_[static_cast<std::size_t>(EventKind::silence)].reset();
}

/// Times are shown from the first one on; who looks already begins anew with that.
void LiveView::begin_at(std::int64_t utime_us) {
  if (epoch_us_) return;
  epoch_us_ = utime_us;
  ++generation_;
}

void LiveView::emit(EventKind kind, Json data, const Heard& now) {
  data["sent_us"] = now.wall_us;
  ViewEvent event = make_event(kind, ++events_, data);
  lookers_->push(event);
  if (kind == EventKind::journal) {
    journal_.push_back(std::move(event));
    if (journal_.size() > limits_.journal_lines) journal_.pop_front();
  } else {
    newest_[static_cast<std::size_t>(kind)] = std::move(event);
  }
}

void LiveView::restart(const Heard& heard) {
  LiveView anew(version_, source_, *lookers_, since_, limits_);
  anew.generation_ = generation_ + 1;
  anew.restarts_ = restarts_ + 1;
  anew.events_ = events_;
  anew.rig_ = rig_;
  anew.rig_toml_ = rig_toml_;
  anew.bearings_ = std::move(bearings_);
  anew.bearings_.clear();
  anew.picture_.number = picture_.number;
  anew.journal_ = std::move(journal_);
  *this = std::move(anew);
  hear(heard);
  counted_since_ = heard.at;
  tell({"the daemon started anew, or its recording did", "info"}, heard);
}

void LiveView::take_pose(const pose_cov_t& pose, const Heard& heard) {
  if (pose_ && (pose.seq < pose_->seq || pose_->utime - pose.utime > kBeganAgain_us)) restart(heard);
  hear(heard);
  begin_at(pose.utime);
  ++poses_since_;
  const double latency_s = 1e-6 * static_cast<double>(heard.wall_us - pose.utime);
  latency_s_ = std::abs(latency_s) < kSameClock_s ? latency_s : std::numeric_limits<double>::quiet_NaN();
  if (pose_ && moved(*pose_, pose))
    history_.drove(std::clamp(t_s(pose.utime) - t_s(pose_->utime), 0.0, kLongestStep_s));
  trail_.add(trail_point(t_s(pose.utime), pose));
  pose_ = pose;
  pose_pace_.waits = true;
  if (heard.at >= pose_pace_.next) send_pose(heard);
}

void LiveView::send_pose(const Heard& now) {
  pose_pace_.sent(now.at);
  Json json = pose_json(*pose_);
  json["t"] = t_s(pose_->utime);
  json["utime"] = pose_->utime;
  emit(EventKind::pose, std::move(json), now);
}

void LiveView::take_truth(const TruthPose& truth, const Heard& heard) {
  hear(heard);
  begin_at(to_us(truth.stamp));
  truth_.add({.t_s = t_s(to_us(truth.stamp)), .T_map_body = truth.T_world_body, .T_odom_body = {}});
  truth_pose_ = truth;
  truth_pace_.waits = true;
  if (heard.at >= truth_pace_.next) send_truth(heard);
}

void LiveView::send_truth(const Heard& now) {
  truth_pace_.sent(now.at);
  const Pose2& T_world_body = truth_pose_->T_world_body;
  emit(EventKind::truth,
       {{"t", t_s(to_us(truth_pose_->stamp))},
        {"x", T_world_body.x_m},
        {"y", T_world_body.y_m},
        {"heading", T_world_body.heading_rad}},
       now);
}

void LiveView::take_bearings(BearingSet set, const Heard& heard) {
  hear(heard);
  begin_at(to_us(set.stamp));
  ++images_since_;
  bearings_.take(std::move(set), heard.at);
  send_bearings_if_due(heard);
}

void LiveView::take_sightings(const sightings_t& sightings, const Heard& heard) {
  hear(heard);
  begin_at(sightings.utime);
  for (const sighting_t& sighting : sightings.sightings) history_.saw(sighting.landmark_id, t_s(sightings.utime));
  bearings_.take(sightings);
  send_bearings_if_due(heard);
}

void LiveView::send_bearings_if_due(const Heard& now) {
  if (!bearings_.waits() || now.at < bearings_.due()) return;
  Json json = bearings_.sent(now.at);
  json["t"] = t_s(to_us(bearings_.stamp()));
  emit(EventKind::bearings, std::move(json), now);
}

/// What claims to come in more pieces would only be remembered.
template <class Piece>
bool LiveView::is_bounded(const Piece& piece) const {
  return static_cast<std::size_t>(piece.chunks) <= limits_.pieces;
}

void LiveView::take_map(const map_chunk_t& piece, const Heard& heard) {
  hear(heard);
  if (!is_bounded(piece) || !map_.take(piece)) return;
  begin_at(map_.utime());
  map_sequence_ = piece.seq;
  history_.take_map(map_.whole(), t_s(map_.utime()));
  send_map(heard);
}

/// Only when it says something else than before.
void LiveView::send_map(const Heard& now) {
  Json json = history_.json(map_.whole());
  if (json == told_map_) return;
  told_map_ = json;
  json["t"] = t_s(map_.utime());
  json["seq"] = map_sequence_;
  emit(EventKind::map, std::move(json), now);
}

void LiveView::take_path(const path_t& piece, const Heard& heard) {
  hear(heard);
  if (!is_bounded(piece) || !path_.take(piece)) return;
  begin_at(path_.utime());
  const std::vector<path_pose_t>& whole = path_.whole();
  const std::size_t every = whole.size() / limits_.path_points + 1;
  Json points = Json::array();
  for (std::size_t i = 0; i < whole.size(); i += every)
    points.push_back({rounded_json(t_s(whole[i].utime), 1e3), rounded_json(whole[i].x_m, 1e4),
                      rounded_json(whole[i].y_m, 1e4), rounded_json(whole[i].heading_rad, 1e5)});
  emit(EventKind::path, {{"t", t_s(path_.utime())}, {"seq", piece.seq}, {"points", std::move(points)}}, heard);
}

void LiveView::take_status(const status_t& status, const Heard& heard) {
  if (status.seq < status_sequence_) restart(heard);
  hear(heard);
  status_sequence_ = status.seq;
  begin_at(status.utime);
  for (const News& news : news_.take(status)) tell(news, heard);
  Json json = status_json(status, limits_.text_bytes);
  json["t"] = t_s(status.utime);
  json["rates"] = rates(heard.at);
  json["latency_s"] = number_json(latency_s_);
  json["nis"] = nullptr;
  emit(EventKind::status, std::move(json), heard);
}

/// Since the last status.
Json LiveView::rates(Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - std::exchange(counted_since_, now)).count();
  const auto rate = [seconds](std::uint64_t& count) {
    const auto number = static_cast<double>(std::exchange(count, 0));
    return seconds > 0.1 ? rounded_json(number / seconds, 100.0) : Json(nullptr);
  };
  return {{"pose_hz", rate(poses_since_)}, {"odometry_hz", rate(odometry_since_)}, {"image_hz", rate(images_since_)}};
}

void LiveView::tell(const News& news, const Heard& now) {
  const Json t = pose_ ? Json(t_s(pose_->utime)) : Json(nullptr);
  emit(EventKind::journal, {{"t", t}, {"text", shortened(news.text, limits_.text_bytes)}, {"level", news.level}}, now);
}

void LiveView::take_picture(Stamp stamp, Bytes jpeg, int width_px, int height_px, const Heard& heard) {
  hear(heard);
  if (jpeg.size() > limits_.picture_bytes) return;
  begin_at(to_us(stamp));
  picture_ = {picture_.number + 1, std::make_shared<const std::string>(as_text(jpeg))};
  emit(EventKind::picture,
       {{"t", t_s(to_us(stamp))}, {"seq", picture_.number}, {"width", width_px}, {"height", height_px}}, heard);
}

void LiveView::take_rig(std::string_view toml, const Heard& heard) {
  hear(heard);
  if (toml == rig_toml_) return;
  rig_toml_ = toml;
  const FileResult<Rig> rig = read_rig(toml, "rig.toml");
  rig_ = rig ? rig_json(*rig) : Json(nullptr);
  bearings_.take_rig(rig ? &*rig : nullptr);
  ++generation_;
}

void LiveView::turn(const Heard& now, const std::string& trouble) {
  if (pose_pace_.waits && now.at >= pose_pace_.next) send_pose(now);
  if (truth_pace_.waits && now.at >= truth_pace_.next) send_truth(now);
  send_bearings_if_due(now);
  if (now.at - heard_ < kSilentAfter || (told_silence_ && now.at - *told_silence_ < kTellSilenceEvery)) return;
  told_silence_ = now.at;
  emit(EventKind::silence,
       {{"since_s", std::round(std::chrono::duration<double>(now.at - heard_).count() * 10.0) / 10.0},
        {"trouble", shortened(trouble, limits_.text_bytes)}},
       now);
}

LiveView::Clock::time_point LiveView::next_turn() const {
  Clock::time_point next = told_silence_ ? *told_silence_ + kTellSilenceEvery : heard_ + kSilentAfter;
  if (pose_pace_.waits) next = std::min(next, pose_pace_.next);
  if (truth_pace_.waits) next = std::min(next, truth_pace_.next);
  if (bearings_.waits()) next = std::min(next, bearings_.due());
  return next;
}

ViewEvent LiveView::hello() {
  return make_event(EventKind::hello, ++events_,
                    {{"version", version_},
                     {"source", shortened(source_, limits_.text_bytes)},
                     {"mode", "live"},
                     {"epoch_us", epoch_us_ ? Json(*epoch_us_) : Json(nullptr)},
                     {"limits", {{"trail", limits_.trail_points}, {"landmarks", limits_.landmarks}}},
                     {"rig", rig_}});
}

std::optional<ViewEvent> LiveView::trail_after(double& t_s) {
  const auto points = trail_.after(t_s, limits_.trail_piece);
  if (points.empty()) return std::nullopt;
  t_s = points.back().t_s;
  return make_event(EventKind::trail, ++events_, trail_json(points));
}

std::optional<ViewEvent> LiveView::truth_trail_after(double& t_s) {
  const auto points = truth_.after(t_s, limits_.trail_piece);
  if (points.empty()) return std::nullopt;
  t_s = points.back().t_s;
  return make_event(EventKind::truth_trail, ++events_, truth_trail_json(points));
}

std::vector<ViewEvent> LiveView::newest() const {
  std::vector<ViewEvent> events(journal_.begin(), journal_.end());
  for (const std::optional<ViewEvent>& event : newest_)
    if (event) events.push_back(*event);
  return events;
}

}  // namespace azimuth
