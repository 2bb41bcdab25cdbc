#include "daemon/pipeline/publisher_turn.hpp"

#include <utility>

#include "daemon/pipeline/paces.hpp"
#include "daemon/pipeline/storage.hpp"

namespace azimuth {

PublisherTurn::PublisherTurn(Publisher publisher, Wires wires, Doorbell& bell, std::function<WireLosses()> losses,
                             std::string picture_trouble)
    : publisher_(std::move(publisher)), wires_(wires), bell_(bell), losses_(std::move(losses)) {
  known_.picture = std::move(picture_trouble);
  worked_.fill(Publisher::Clock::now());
  prepare(set_);
  prepare(result_);
  prepare(prediction_);
  if (!wires_.sent) return;
  publisher_.listen([this](std::string_view channel, std::span<const std::byte> message, Stamp) {
    sent_.channel.assign(channel);
    sent_.data.assign(message.begin(), message.end());
    wires_.sent->push(sent_);
  });
}

void PublisherTurn::operator()() {
  bell_.wait(kNap);
  const bool over = wires_.estimates_over.is_set();
  if (wires_.estimates.take(result_)) step();
  if (wires_.predictions.take(prediction_)) predict();
  drain_echoes();
  gather();
  const bool has_path = wires_.paths.take(path_);
  const auto now = Publisher::Clock::now();
  if (has_path) over ? publisher_.last_path(*path_) : publisher_.path(*path_);
  if (over && !wires_.published_all.is_set()) {
    publisher_.send_last(now, status_);
    wires_.statuses.publish(status_);
    wires_.published_all.set();
    if (wires_.poses_out) wires_.poses_out->tell(Stamp::max());
  } else if (publisher_.send_due(now, status_)) {
    wires_.statuses.publish(status_);
  }
  if (!over) ask_for_path(now);
}

void PublisherTurn::ask_for_path(Publisher::Clock::time_point now) {
  if (path_ && publisher_.wants_path(now)) wires_.path_storage.publish(path_);
}

void PublisherTurn::step() {
  const Stamp stamp = result_.estimate.stamp;
  publisher_.step(result_);
  if (wires_.poses_out) wires_.poses_out->tell(stamp);
}

/// The health of a step already takes the devices into account. A prediction may continue for long without images, so
/// its health is corrected by the state of the devices.
void PublisherTurn::predict() {
  const ToldHealth told = told_health(prediction_, known_.odometer, known_.camera);
  prediction_.health = told.health;
  prediction_.reason = told.reason;
  publisher_.prediction(prediction_);
}

void PublisherTurn::drain_echoes() {
  for (std::size_t i = 0; i < kOdometryRing && wires_.odometry_echo.pop(reading_); ++i) publisher_.odometry(reading_);
  for (std::size_t i = 0; i < kBearingsRing && wires_.bearings_echo.pop(set_); ++i) publisher_.bearings(set_);
}

/// A device that starts or stops working makes the next status due at once.
void PublisherTurn::gather_devices() {
  const auto now = Publisher::Clock::now();
  for (const std::size_t i : {0U, 1U}) {
    DeviceStatus& device = i == 0 ? known_.odometer : known_.camera;
    const bool worked = device.works;
    wires_.devices[i].take(device);
    if (device.works != worked) publisher_.hasten_status();
    if (device.works) worked_[i] = now;
    device.away = now - worked_[i];
  }
}

void PublisherTurn::gather() {
  gather_devices();
  wires_.perception.take(known_.perception);
  wires_.record.take(known_.record);
  wires_.frame_record.take(known_.frame_record);
  wires_.map.take(known_.map);
  wires_.process.take(known_.process);
  wires_.findings.take(known_.samples);
  known_.wires = losses_();
  status_ = known_;
}

}  // namespace azimuth
