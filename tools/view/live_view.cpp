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
/// A message older by this much is not a delayed datagram: a recording was started again.
constexpr std::int64_t kBeganAgain_us = 1'000'000;
/// Changes below these count as standing.
constexpr double kMoved_m = 1e-4, kTurned_rad = 1e-4, kLongestStep_s = 2.0;

enum class Order { next, overtaken, anew };

/// Numbers and stamps increase together within a session. A message with a smaller number and a newer stamp therefore
/// belongs to a new session. A message with an older stamp was delayed, within the session or from the previous one.
Order order_after(const std::optional<SessionMark>& last, const SessionMark& now) {
  if (!last) return Order::next;
  if (last->stamp_us - now.stamp_us >= kBeganAgain_us) return Order::anew;
  if (now.stamp_us > last->stamp_us) return now.number > last->number ? Order::next : Order::anew;
  if (now.stamp_us == last->stamp_us) return now.number >= last->number ? Order::next : Order::overtaken;
  return Order::overtaken;
}

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
      limits_(limits),
      since_(now),
      events_(lookers, limits.journal_lines),
      silence_(now),
      measured_(now),
      trail_(limits.trail_points),
      truth_trail_(limits.trail_points),
      map_(limits.landmarks),
      bearings_(limits.bearings),
      pose_{{kPoseInterval}},
      truth_{{kTruthInterval}} {}

double LiveView::t_s(std::int64_t utime_us) const {
  return 1e-6 * static_cast<double>(utime_us - epoch_us_.value_or(utime_us));
}

void LiveView::hear(const Reception& heard) {
  silence_.hear(heard.at);
  events_.forget(EventKind::silence);
}

/// Sets the origin of displayed times to the first stamp. Connected clients start again with it.
void LiveView::begin_at(std::int64_t utime_us) {
  if (epoch_us_) return;
  epoch_us_ = utime_us;
  ++generation_;
}

void LiveView::restart(const Reception& heard) {
  LiveView anew(version_, source_, events_.lookers(), heard.at, limits_);
  anew.since_ = since_;
  anew.generation_ = generation_ + 1;
  anew.restarts_ = restarts_ + 1;
  anew.events_ = std::move(events_);
  anew.events_.begin_anew();
  anew.rig_ = rig_;
  anew.rig_toml_ = rig_toml_;
  anew.bearings_ = std::move(bearings_);
  anew.bearings_.clear();
  anew.picture_.number = picture_.number;
  *this = std::move(anew);
  tell({"the daemon started anew, or its recording did", "info"}, heard);
}

/// True if the message is the newest of its kind. A message of a new session causes a restart; a delayed one is
/// ignored.
bool LiveView::takes(std::optional<SessionMark> Marks::*kind, const SessionMark& mark, const Reception& heard) {
  const Order order = order_after(marks_.*kind, mark);
  if (order == Order::anew) restart(heard);
  hear(heard);
  if (order == Order::overtaken) return false;
  marks_.*kind = mark;
  return true;
}

void LiveView::take_pose(const pose_cov_t& pose, const Reception& heard) {
  if (!takes(pose.predicted != 0 ? &Marks::prediction : &Marks::step, {pose.seq, pose.utime}, heard)) return;
  begin_at(pose.utime);
  measured_.pose(pose.utime, heard);
  if (const auto& last = pose_.newest; last && moved(*last, pose))
    map_.drove(std::clamp(t_s(pose.utime) - t_s(last->utime), 0.0, kLongestStep_s));
  trail_.add(trail_point(t_s(pose.utime), pose));
  pose_.newest = pose;
  pose_.pace.waits = true;
  if (heard.at >= pose_.pace.next) send_pose(heard);
}

void LiveView::send_pose(const Reception& now) {
  pose_.pace.sent(now.at);
  Json json = pose_json(*pose_.newest);
  json["t"] = t_s(pose_.newest->utime);
  json["utime"] = pose_.newest->utime;
  events_.tell(EventKind::pose, std::move(json), now);
}

void LiveView::take_truth(const TruthPose& truth, const Reception& heard) {
  hear(heard);
  begin_at(to_us(truth.stamp));
  truth_trail_.add({.t_s = t_s(to_us(truth.stamp)), .T_map_body = truth.T_world_body, .T_odom_body = {}});
  truth_.newest = truth;
  truth_.pace.waits = true;
  if (heard.at >= truth_.pace.next) send_truth(heard);
}

void LiveView::send_truth(const Reception& now) {
  truth_.pace.sent(now.at);
  const Pose2& T_world_body = truth_.newest->T_world_body;
  events_.tell(EventKind::truth,
               {{"t", t_s(to_us(truth_.newest->stamp))},
                {"x", T_world_body.x_m},
                {"y", T_world_body.y_m},
                {"heading", T_world_body.heading_rad}},
               now);
}

void LiveView::take_bearings(BearingSet set, const Reception& heard) {
  hear(heard);
  begin_at(to_us(set.stamp));
  measured_.image();
  bearings_.take(std::move(set), heard.at);
  send_bearings_if_due(heard);
}

void LiveView::take_sightings(const sightings_t& sightings, const Reception& heard) {
  hear(heard);
  begin_at(sightings.utime);
  map_.take(sightings, t_s(sightings.utime));
  bearings_.take(sightings);
  send_bearings_if_due(heard);
}

void LiveView::take_expectations(const expectations_t& expectations, const Reception& heard) {
  hear(heard);
  begin_at(expectations.utime);
  measured_.innovations(expectations.nis, expectations.compared);
  map_.take(expectations);
  bearings_.take(expectations);
  send_bearings_if_due(heard);
}

void LiveView::send_bearings_if_due(const Reception& now) {
  if (!bearings_.waits() || now.at < bearings_.due()) return;
  Json json = bearings_.sent(now.at);
  json["t"] = t_s(to_us(bearings_.stamp()));
  events_.tell(EventKind::bearings, std::move(json), now);
}

/// Rejects messages that claim too many pieces, since storing their pieces would take unbounded memory.
template <class Piece>
bool LiveView::is_bounded(const Piece& piece) const {
  return static_cast<std::size_t>(piece.chunks) <= limits_.pieces;
}

void LiveView::take_map(const map_chunk_t& piece, const Reception& heard) {
  hear(heard);
  if (!is_bounded(piece) || !map_.take(piece)) return;
  begin_at(map_.utime());
  std::optional<Json> json = map_.changed(t_s(map_.utime()));
  if (!json) return;
  (*json)["t"] = t_s(map_.utime());
  events_.tell(EventKind::map, *std::move(json), heard);
}

void LiveView::take_path(const path_t& piece, const Reception& heard) {
  hear(heard);
  if (!is_bounded(piece) || !path_.take(piece)) return;
  begin_at(path_.utime());
  const std::vector<path_pose_t>& whole = path_.whole();
  const std::size_t every = whole.size() / limits_.path_points + 1;
  Json points = Json::array();
  for (std::size_t i = 0; i < whole.size(); i += every)
    points.push_back({rounded_json(t_s(whole[i].utime), 1e3), rounded_json(whole[i].x_m, 1e4),
                      rounded_json(whole[i].y_m, 1e4), rounded_json(whole[i].heading_rad, 1e5)});
  events_.tell(EventKind::path, {{"t", t_s(path_.utime())}, {"seq", piece.seq}, {"points", std::move(points)}}, heard);
}

void LiveView::take_status(const status_t& status, const Reception& heard) {
  if (!takes(&Marks::status, {status.seq, status.utime_mono}, heard)) return;
  const bool is_dated = status.estimates > 0;  // the date is that of the newest estimate
  if (is_dated) begin_at(status.utime);
  for (const News& news : news_.take(status)) tell(news, heard);
  Json json = status_json(status, limits_.text_bytes);
  json["t"] = is_dated ? Json(t_s(status.utime)) : Json(nullptr);
  measured_.put_into(json, heard.at);
  if (kept_) json["kept"] = kept_json(*kept_, heard.wall_us);
  events_.tell(EventKind::status, std::move(json), heard);
}

void LiveView::take_kept(const kept_t& kept, const Reception& heard) {
  hear(heard);
  kept_ = kept;
}

void LiveView::tell(const News& news, const Reception& now) {
  const Json t = pose_.newest ? Json(t_s(pose_.newest->utime)) : Json(nullptr);
  events_.tell(EventKind::journal,
               {{"t", t}, {"text", shortened(news.text, limits_.text_bytes)}, {"level", news.level}}, now);
}

void LiveView::take_picture(Stamp stamp, Bytes jpeg, int width_px, int height_px, const Reception& heard) {
  hear(heard);
  if (jpeg.size() > limits_.picture_bytes) return;
  begin_at(to_us(stamp));
  picture_ = {picture_.number + 1, std::make_shared<const std::string>(as_text(jpeg))};
  events_.tell(EventKind::picture,
               {{"t", t_s(to_us(stamp))}, {"seq", picture_.number}, {"width", width_px}, {"height", height_px}}, heard);
}

void LiveView::take_rig(std::string_view toml, const Reception& heard) {
  hear(heard);
  if (toml == rig_toml_) return;
  rig_toml_ = toml;
  const FileResult<Rig> rig = read_rig(toml, "rig.toml");
  rig_ = rig ? rig_json(*rig) : Json(nullptr);
  bearings_.take_rig(rig ? &*rig : nullptr);
  ++generation_;
}

void LiveView::turn(const Reception& now, const std::string& trouble) {
  if (pose_.pace.waits && now.at >= pose_.pace.next) send_pose(now);
  if (truth_.pace.waits && now.at >= truth_.pace.next) send_truth(now);
  send_bearings_if_due(now);
  if (now.at >= silence_.due()) tell_silence(now, trouble);
  events_.beat(now);
}

void LiveView::tell_silence(const Reception& now, const std::string& trouble) {
  const double since_s = silence_.told(now.at);
  events_.tell(EventKind::silence,
               {{"since_s", std::round(since_s * 10.0) / 10.0}, {"trouble", shortened(trouble, limits_.text_bytes)}},
               now);
}

LiveView::Clock::time_point LiveView::next_turn() const {
  Clock::time_point next = std::min(silence_.due(), events_.next_beat());
  if (pose_.pace.waits) next = std::min(next, pose_.pace.next);
  if (truth_.pace.waits) next = std::min(next, truth_.pace.next);
  if (bearings_.waits()) next = std::min(next, bearings_.due());
  return next;
}

ViewEvent LiveView::hello() {
  return events_.made(EventKind::hello,
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
  return events_.made(EventKind::trail, trail_json(points));
}

std::optional<ViewEvent> LiveView::truth_trail_after(double& t_s) {
  const auto points = truth_trail_.after(t_s, limits_.trail_piece);
  if (points.empty()) return std::nullopt;
  t_s = points.back().t_s;
  return events_.made(EventKind::truth_trail, truth_trail_json(points));
}

}  // namespace azimuth
