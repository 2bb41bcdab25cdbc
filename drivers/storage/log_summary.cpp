#include "drivers/storage/log_summary.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "drivers/storage/each_event.hpp"
#include "drivers/storage/run_folder.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/messages.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

constexpr double kMicroseconds = 1e-6;

/// The text in the brackets of "running (p3dx-sh GJC_3156)".
std::string name_within(std::string_view status) {
  const std::size_t begin = status.find('('), end = status.rfind(')');
  if (begin == std::string_view::npos || end == std::string_view::npos || end < begin) return {};
  return std::string(status.substr(begin + 1, end - begin - 1));
}

class SummaryReader {
 public:
  void take(const LogEvent& event) {
    if (std::exchange(begun_, true)) {
      summary_.first_us = std::min(summary_.first_us, event.utime_us);
      summary_.last_us = std::max(summary_.last_us, event.utime_us);
    } else {
      summary_.first_us = summary_.last_us = event.utime_us;
    }
    if (is_on(event.channel, channel::kDocument)) use(decode_document(event.data), &SummaryReader::take_document);
    if (is_on(event.channel, channel::kPose)) use(decode_pose(event.data), &SummaryReader::take_pose);
    if (is_on(event.channel, channel::kStatus)) use(decode_status(event.data), &SummaryReader::take_status);
  }

  LogSummary finish(const EventTotals& totals) && {
    summary_.damaged_bytes = totals.damaged_bytes;
    summary_.prefix = prefix_.value_or("");
    return std::move(summary_);
  }

 private:
  /// True: the event is on the channel `name`. The first such event determines the prefix of all channels.
  bool is_on(std::string_view channel, std::string_view name) {
    if (!channel.ends_with(name)) return false;
    channel.remove_suffix(name.size());
    if (!prefix_) prefix_ = channel;
    return channel == *prefix_;
  }
  template <class Message>
  void use(const std::optional<Message>& message, void (SummaryReader::*taker)(const Message&)) {
    if (message)
      (this->*taker)(*message);
    else
      ++summary_.malformed;
  }

  void take_document(const document_t& document) {
    const std::string text(document.data.begin(), document.data.end());
    if (document.name == kSegmentDocument) return take_mark(text);
    if (document.name == kVersionDocument) keep_first(summary_.version, text.substr(0, text.find('\n')));
    if (document.name == kRigFile) keep_first(summary_.rig_toml, text);
    if (document.name == kConfigurationDocument) keep_first(summary_.configuration_toml, text);
  }
  static void keep_first(std::string& kept, const std::string& text) {
    if (kept.empty()) kept = text;
  }
  void take_mark(std::string_view text) {
    const std::optional<SegmentMark> mark = parse_segment_mark(text);
    if (!mark || mark->number < next_segment_) return void(++summary_.malformed);
    summary_.missing_segments += mark->number - next_segment_;
    summary_.lost_events = mark->lost_events;  // the mark counts since the session began
    next_segment_ = mark->number + 1;
  }

  void take_pose(const pose_cov_t& pose) {
    const Pose2 in_odometry{pose.odom_x_m, pose.odom_y_m, pose.odom_heading_rad};
    const Pose2 in_map{pose.x_m, pose.y_m, pose.heading_rad};
    if (!is_plausible(in_map) || !is_plausible(in_odometry) || !is_plausible_stamp(pose.utime))
      return void(++summary_.malformed);
    if (pose.predicted == 0) take_step(in_map);
    advance(pose, in_odometry);
  }
  void take_step(const Pose2& pose) {
    ++summary_.poses;
    PoseBox& box = summary_.box ? *summary_.box : summary_.box.emplace(PoseBox{pose.x_m, pose.y_m, pose.x_m, pose.y_m});
    box.min_x_m = std::min(box.min_x_m, pose.x_m);
    box.min_y_m = std::min(box.min_y_m, pose.y_m);
    box.max_x_m = std::max(box.max_x_m, pose.x_m);
    box.max_y_m = std::max(box.max_y_m, pose.y_m);
  }
  /// A step may be older than the prediction sent before it, which has already covered that time, so it is skipped. A
  /// much older stamp comes from a clock that was set back.
  void advance(const pose_cov_t& pose, const Pose2& in_odometry) {
    const double elapsed_s = last_ ? kMicroseconds * static_cast<double>(pose.utime - last_->utime_us) : 0.0;
    if (elapsed_s < 0.0 && elapsed_s > -LogSummary::kLongestSilence_s) return;
    if (last_ && elapsed_s >= 0.0) {
      summary_.distance_m += std::hypot(in_odometry.x_m - last_->x_m, in_odometry.y_m - last_->y_m);
      (elapsed_s > LogSummary::kLongestSilence_s ? summary_.silent_s : time_in(last_->health)) += elapsed_s;
    }
    last_ = {pose.utime, in_odometry.x_m, in_odometry.y_m, pose.health};
  }
  /// The time counter of a state. States unknown to this version count as silence.
  double& time_in(std::int8_t health) {
    const bool known = health >= 0 && static_cast<std::size_t>(health) < summary_.health_s.size();
    return known ? summary_.health_s[static_cast<std::size_t>(health)] : summary_.silent_s;
  }

  void take_status(const status_t& status) { keep_first(summary_.odometer, name_within(status.odometer)); }

  struct Last {
    std::int64_t utime_us;
    double x_m, y_m;
    std::int8_t health;
  };
  LogSummary summary_;
  std::optional<std::string> prefix_;
  std::optional<Last> last_;
  std::uint64_t next_segment_ = 0;
  bool begun_ = false;
};

}  // namespace

FileResult<LogSummary> read_log_summary(const std::filesystem::path& log_or_session) {
  SummaryReader reader;
  const FileResult<EventTotals> read = each_event(log_or_session, [&](const LogEvent& event) { reader.take(event); });
  if (!read) return failure(read.error());
  return std::move(reader).finish(*read);
}

}  // namespace azimuth
