#include "daemon/pipeline/background_turns.hpp"

#include <utility>

#include "daemon/pipeline/paces.hpp"
#include "daemon/pipeline/source.hpp"
#include "daemon/pipeline/storage.hpp"

namespace azimuth {
namespace {

/// How long an image waits for the estimator before it is painted without the expected bearings.
constexpr std::chrono::milliseconds kPainterPatience{500};

/// How often the growth of a log is reported.
constexpr std::chrono::seconds kGrowthInterval{1};

/// How long an image waits for its pose before it is recorded anyway. It is longer than the computation of a pose.
constexpr std::chrono::milliseconds kFrameRecorderPatience{50};

}  // namespace

/// An image that the estimator does not process, because odometry is missing, is painted without expected bearings.
void PainterTurn::operator()() {
  bell_.wait(kNap);
  const auto now = std::chrono::steady_clock::now();
  if (wires_.seen_images.take(image_)) {
    has_image_ = true;
    waits_until_ = now + kPainterPatience;
  }
  wires_.expected_images.take(expected_);
  if (!has_image_) return;
  const bool belong_together = expected_.stamp == image_.seen.stamp;
  if (!belong_together && now < waits_until_) return;
  if (!belong_together) expected_.bearings.clear();
  painter_.paint(image_, expected_);
  has_image_ = false;
}

void LogReport::tell(const RecorderStatus& status, Recorder::Clock::time_point now) {
  const std::string& text = status.on ? status.file : status.reason;
  const bool is_news = text != last_.text || status.lost_events != last_.losses;
  if (!is_news && (status.kept_bytes == last_.kept_bytes || now < next_)) return;
  next_ = now + kGrowthInterval;
  last_.text = text;
  last_.losses = status.lost_events;
  last_.kept_bytes = status.kept_bytes;
  last_.quota_bytes = status.quota_bytes;
  last_.free_mb = status.free_mb;
  RecordStatus news = last_;
  wire_.publish(news);
}

RecorderTurn::RecorderTurn(Recorder& recorder, Wires wires, Doorbell& bell)
    : recorder_(recorder),
      wires_(wires),
      bell_(bell),
      report_(wires.status),
      session_told_(!recorder.session().empty()) {
  prepare(taken_.bearings);
}

void RecorderTurn::operator()() {
  bell_.wait(kNap);
  for (std::size_t i = 0; i < kTakenRing && wires_.taken.pop(taken_); ++i) {
    if (taken_.is_odometry)
      recorder_.odometry(taken_.odometry);
    else
      recorder_.bearings(taken_.bearings);
  }
  for (std::size_t i = 0; i < kSentRing && wires_.sent.pop(sent_); ++i) recorder_.message(sent_.channel, sent_.data);
  const auto now = Recorder::Clock::now();
  recorder_.turn(now);
  report_.tell(recorder_.status(), now);
  if (wires_.session) tell_session();
}

/// Tells the frame recorder of a session that could not be started at once because of trouble with the disk.
void RecorderTurn::tell_session() {
  if (session_told_ || recorder_.session().empty()) return;
  session_told_ = true;
  std::string session = recorder_.session();
  wires_.session->publish(session);
}

void FrameRecorderTurn::operator()() {
  bell_.wait(has_image_ ? kFrameRecorderPatience : kNap);
  if (wires_.session.take(session_)) recorder_.begin(session_);
  for (std::size_t i = 0; i <= kImagesRing && take_image() && has_waited(); ++i) {
    recorder_.image(image_);
    has_image_ = false;
  }
  const auto now = FrameRecorder::Clock::now();
  recorder_.turn(now);
  report_.tell(recorder_.status(), now);
}

bool FrameRecorderTurn::take_image() {
  if (has_image_) return true;
  has_image_ = wires_.images.pop(image_);
  waits_until_ = std::chrono::steady_clock::now() + kFrameRecorderPatience;
  return has_image_;
}

bool FrameRecorderTurn::has_waited() const {
  return image_.stamp <= wires_.poses_out.newest() || wires_.images.size() >= kImagesRing / 2 ||
         std::chrono::steady_clock::now() >= waits_until_;
}

void KeeperTurn::operator()() {
  bell_.wait(kNap);
  const bool has_map = wires_.maps.take(map_);  // first, because the motion since that map was published before the map
  if (OdometryKeeper* const odometry = keeper_.odometry()) {
    const bool remembers = wires_.memories.take(memory_), went = wires_.ways.take(ways_);
    if (remembers) odometry->odometer_is(memory_);
    if (went) odometry->robot_went(ways_);
    if (remembers || went) odometry->write();
  }
  if (has_map && !keeper_.save(*map_)) map_->clear();  // an empty map tells the estimator that it was not saved
  if (map_ && keeper_.is_due(MapKeeper::Clock::now())) wires_.map_storage.publish(map_);
  report();
}

void KeeperTurn::save_last(EstimatorStage& estimator, Source& odometer) {
  if (std::exchange(saved_last_, true)) return;
  MapSnapshot map;
  const bool has_map = estimator.save_map(map);
  if (has_map) estimator.map_is_made();
  if (OdometryKeeper* const odometry = keeper_.odometry()) leave_odometry(*odometry, estimator, odometer);
  if (has_map) keeper_.save(map);
}

void KeeperTurn::leave_odometry(OdometryKeeper& odometry, EstimatorStage& estimator, Source& odometer) {
  if (!odometer.remember(memory_)) return odometry.forget();
  odometry.odometer_is(memory_);
  if (!estimator.has_odometry()) return;
  if (!estimator.since_map(ways_.since_map.emplace())) ways_.since_map.reset();
  if (!estimator.since_made_map(ways_.since_made_map.emplace())) ways_.since_made_map.reset();
  odometry.robot_went(ways_);
  odometry.write();
}

void KeeperTurn::report() {
  const MapKeeperStatus& status = keeper_.status();
  if (status.text == last_.text && status.trouble == last_.trouble && status.written_us == last_.written_us) return;
  last_ = {status.text, status.trouble, status.written_us};
  MapStatus news = last_;
  wires_.status.publish(news);
}

}  // namespace azimuth
