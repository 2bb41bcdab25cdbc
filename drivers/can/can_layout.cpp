#include "drivers/can/can_layout.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>

namespace azimuth {
namespace {

class LayoutFinder {
 public:
  LayoutFinder(const CanSettings& settings, const Dbc* dbc) : settings_(settings), dbc_(dbc) {}

  FileResult<CanLayout> find() {
    layout_.odometry = settings_.odometry;
    if (settings_.odometry == CanOdometryKind::pose) {
      pose();
    } else {
      wheels();
    }
    if (!settings_.battery.empty()) layout_.battery = required("battery", settings_.battery);
    layout_.emergency_stop = optional("emergency_stop", settings_.emergency_stop);
    layout_.bumper = optional("bumper", settings_.bumper);
    layout_.charging = optional("charging", settings_.charging);
    if (!errors_.empty()) return failure(errors_);
    return std::move(layout_);
  }

 private:
  void wheels() {
    const double turning_m_s = 0.5 * settings_.max_turn_rad_s * settings_.track_m;
    const double unit = settings_.odometry == CanOdometryKind::ticks ? metres_per_tick() : speed_unit();
    positive("track_m", settings_.track_m);
    layout_.track_m = settings_.track_m;
    motion("left", settings_.left, settings_.left_reversed ? -unit : unit, settings_.max_speed_m_s + turning_m_s);
    motion("right", settings_.right, settings_.right_reversed ? -unit : unit, settings_.max_speed_m_s + turning_m_s);
  }

  void pose() {
    motion("x", settings_.x, settings_.position_scale_m, settings_.max_speed_m_s);
    motion("y", settings_.y, settings_.position_scale_m, settings_.max_speed_m_s);
    motion("heading", settings_.heading, settings_.heading_scale_rad, settings_.max_turn_rad_s);
  }

  double metres_per_tick() {
    return positive("ticks_per_m", settings_.ticks_per_m) ? 1.0 / settings_.ticks_per_m : 1.0;
  }

  double speed_unit() {
    if (settings_.speed_unit == CanSpeedUnit::m_per_s) return 1.0;
    positive("wheel_radius_m", settings_.wheel_radius_m);
    const bool turns = settings_.speed_unit == CanSpeedUnit::rpm;
    return settings_.wheel_radius_m * (turns ? 2.0 * std::numbers::pi / 60.0 : 1.0);
  }

  void motion(const char* key, const std::string& name, double unit, double fastest_per_s) {
    if (const auto signal = required(key, name)) layout_.motion.push_back({*signal, unit, fastest_per_s});
  }

  std::optional<CanSignal> optional(const char* key, const std::string& name) {
    return name.empty() ? std::nullopt : required(key, name);
  }

  std::optional<CanSignal> required(const char* key, const std::string& name) {
    if (name.empty()) return refuse(key, "is missing: the signal is needed for this kind of odometry");
    if (const CanSignalSettings* const described = in_settings(name)) return with_multiplexer(key, *described);
    if (const DbcSignal* const signal = dbc_ == nullptr ? nullptr : dbc_->find(name)) {
      if (!signal->problem) return signal->signal;
      return refuse(key, fmt::format("{} ({}:{}) {}", name, dbc_->file, signal->line, *signal->problem));
    }
    return refuse(key, fmt::format("there is no signal \"{}\" in daemon.can.signal{}", name,
                                   dbc_ == nullptr ? "" : " or in " + dbc_->file));
  }

  std::optional<CanSignal> with_multiplexer(const char* key, const CanSignalSettings& described) {
    CanSignal signal = described_signal(described);
    if (!described.multiplexer.empty()) {
      const CanSignalSettings* const by = in_settings(described.multiplexer);
      if (by == nullptr || described_signal(*by).frame != signal.frame)
        return refuse(key, fmt::format("there is no multiplexer \"{}\" in its frame", described.multiplexer));
      signal.multiplexer = {described_signal(*by).bits, static_cast<std::uint64_t>(described.multiplexer_value)};
    }
    if (const auto problem = problem_of(signal))
      return refuse(key, fmt::format("signal \"{}\": {}", described.name, *problem));
    return signal;
  }

  const CanSignalSettings* in_settings(const std::string& name) const {
    const auto found = std::ranges::find(settings_.signals, name, &CanSignalSettings::name);
    return found == settings_.signals.end() ? nullptr : &*found;
  }

  bool positive(const char* key, double value) {
    if (value > 0.0) return true;
    refuse(key, "is missing: it is needed for this kind of odometry");
    return false;
  }

  std::nullopt_t refuse(const char* key, std::string message) {
    errors_.push_back({fmt::format("daemon.can.{}", key), 0, std::move(message)});
    return std::nullopt;
  }

  const CanSettings& settings_;
  const Dbc* dbc_;
  CanLayout layout_;
  FileErrors errors_;
};

}  // namespace

CanSignal described_signal(const CanSignalSettings& settings) {
  return {{static_cast<std::uint32_t>(settings.id), settings.extended},
          {settings.start_bit, settings.length_bits, settings.byte_order},
          settings.number,
          settings.scale,
          settings.offset};
}

std::vector<CanId> CanLayout::ids() const {
  std::vector<CanId> ids;
  for (const CanMotionSignal& part : motion) ids.push_back(part.signal.frame);
  if (battery) ids.push_back(battery->frame);
  for (const auto* flag : {&emergency_stop, &bumper, &charging})
    if (*flag) ids.push_back((*flag)->frame);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

FileResult<CanLayout> find_can_layout(const CanSettings& settings, const Dbc* dbc) {
  return LayoutFinder(settings, dbc).find();
}

}  // namespace azimuth
