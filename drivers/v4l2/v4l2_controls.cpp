#include <initializer_list>
#include <optional>

#include "drivers/v4l2/v4l2_setup.hpp"

namespace azimuth::v4l2 {
namespace {

/// The range of a control; none: the camera has no such control that can be set.
std::optional<v4l2_queryctrl> query(const Handle& handle, std::uint32_t id) {
  v4l2_queryctrl answer{};
  answer.id = id;
  if (handle.call(VIDIOC_QUERYCTRL, answer) != 0) return std::nullopt;
  constexpr std::uint32_t kNotOurs = V4L2_CTRL_FLAG_DISABLED | V4L2_CTRL_FLAG_READ_ONLY;
  return (answer.flags & kNotOurs) == 0 ? std::optional(answer) : std::nullopt;
}

/// Sends or receives `value`. Returns 0 or errno.
int exchange(const Handle& handle, unsigned long request, std::uint32_t id, int& value) {
  v4l2_ext_control control{};
  control.id = id;
  control.value = value;
  v4l2_ext_controls all{};
  all.which = V4L2_CTRL_WHICH_CUR_VAL;
  all.count = 1;
  all.controls = &control;
  const int error = handle.call(request, all);
  value = control.value;
  return error;
}

bool has_menu_item(const Handle& handle, std::uint32_t id, int index) {
  v4l2_querymenu item{};
  item.id = id;
  item.index = static_cast<std::uint32_t>(index);
  return handle.call(VIDIOC_QUERYMENU, item) == 0;
}

/// Sets controls and reads them back, with the names that users know.
class Setter {
 public:
  Setter(const Handle& handle, std::vector<std::string>& refused) : handle_(handle), refused_(refused) {}

  bool has(std::uint32_t id) const { return query(handle_, id).has_value(); }
  /// The first of `values` that is in the menu.
  std::optional<int> first_in_menu(std::uint32_t id, std::initializer_list<int> values) const {
    for (const int value : values)
      if (has_menu_item(handle_, id, value)) return value;
    return std::nullopt;
  }
  void set(const std::string& name, std::uint32_t id, int wanted) {
    const auto range = query(handle_, id);
    if (!range) return refuse("has no " + name + " that could be set");
    if (wanted < range->minimum || wanted > range->maximum)
      return refuse(name + ' ' + std::to_string(wanted) + " is beyond its " + std::to_string(range->minimum) + " to " +
                    std::to_string(range->maximum));
    int value = wanted;
    if (const int error = exchange(handle_, VIDIOC_S_EXT_CTRLS, id, value))
      return refuse("does not take " + name + ' ' + std::to_string(wanted) + ": " + error_text(error));
    int actual = 0;
    if (const int error = exchange(handle_, VIDIOC_G_EXT_CTRLS, id, actual))
      return refuse("does not say its " + name + ": " + error_text(error));
    if (actual != wanted) refuse(name + " is " + std::to_string(actual) + ", asked for " + std::to_string(wanted));
  }
  void refuse(std::string sentence) { refused_.push_back(std::move(sentence)); }

 private:
  const Handle& handle_;
  std::vector<std::string>& refused_;
};

/// A control with a switch for the camera's automatic setting, and a fixed value.
struct Pair {
  const char* name;
  std::uint32_t automatic;
  std::uint32_t value;
};

void apply(Setter& setter, const Pair& pair, const ControlChoice& choice) {
  if (choice.mode == ControlChoice::Mode::keep) return;
  const std::string name = pair.name;
  const bool automatic = choice.mode == ControlChoice::Mode::automatic;
  if (setter.has(pair.automatic)) setter.set("automatic " + name, pair.automatic, automatic ? 1 : 0);
  if (!automatic) setter.set(name, pair.value, choice.value);
}

/// Sets the exposure. The switch for automatic exposure is a menu, and cameras support different items of it.
void apply_exposure(Setter& setter, const ControlChoice& choice, bool may_lower_rate) {
  if (choice.mode == ControlChoice::Mode::keep) return;
  const bool automatic = choice.mode == ControlChoice::Mode::automatic;
  if (setter.has(V4L2_CID_EXPOSURE_AUTO)) {
    const auto mode =
        automatic
            ? setter.first_in_menu(V4L2_CID_EXPOSURE_AUTO, {V4L2_EXPOSURE_APERTURE_PRIORITY, V4L2_EXPOSURE_AUTO})
            : setter.first_in_menu(V4L2_CID_EXPOSURE_AUTO, {V4L2_EXPOSURE_MANUAL, V4L2_EXPOSURE_SHUTTER_PRIORITY});
    if (mode)
      setter.set("exposure mode", V4L2_CID_EXPOSURE_AUTO, *mode);
    else
      setter.refuse(automatic ? "has no automatic exposure" : "has no manual exposure");
  }
  if (automatic && setter.has(V4L2_CID_EXPOSURE_AUTO_PRIORITY))
    setter.set("exposure's priority over the rate", V4L2_CID_EXPOSURE_AUTO_PRIORITY, may_lower_rate ? 1 : 0);
  if (automatic) return;
  const bool absolute = setter.has(V4L2_CID_EXPOSURE_ABSOLUTE);
  setter.set("exposure", absolute ? V4L2_CID_EXPOSURE_ABSOLUTE : V4L2_CID_EXPOSURE, choice.value);
}

void apply_power_line(Setter& setter, PowerLine power_line) {
  constexpr const char* kName = "power line frequency";
  switch (power_line) {
    case PowerLine::keep:
      return;
    case PowerLine::off:
      return setter.set(kName, V4L2_CID_POWER_LINE_FREQUENCY, V4L2_CID_POWER_LINE_FREQUENCY_DISABLED);
    case PowerLine::hz50:
      return setter.set(kName, V4L2_CID_POWER_LINE_FREQUENCY, V4L2_CID_POWER_LINE_FREQUENCY_50HZ);
    case PowerLine::hz60:
      return setter.set(kName, V4L2_CID_POWER_LINE_FREQUENCY, V4L2_CID_POWER_LINE_FREQUENCY_60HZ);
    case PowerLine::automatic:
      return setter.set(kName, V4L2_CID_POWER_LINE_FREQUENCY, V4L2_CID_POWER_LINE_FREQUENCY_AUTO);
  }
}

ControlChoice parsed(const std::string& text) { return parse_control_choice(text).value_or(ControlChoice{}); }

}  // namespace

void apply_controls(const Handle& handle, const V4l2Settings& settings, std::vector<std::string>& refused) {
  Setter setter(handle, refused);
  apply_power_line(setter, settings.power_line);
  apply_exposure(setter, parsed(settings.exposure), settings.exposure_may_lower_rate);
  apply(setter, {"gain", V4L2_CID_AUTOGAIN, V4L2_CID_GAIN}, parsed(settings.gain));
  apply(setter, {"white balance", V4L2_CID_AUTO_WHITE_BALANCE, V4L2_CID_WHITE_BALANCE_TEMPERATURE},
        parsed(settings.white_balance));
  apply(setter, {"focus", V4L2_CID_FOCUS_AUTO, V4L2_CID_FOCUS_ABSOLUTE}, parsed(settings.focus));
}

}  // namespace azimuth::v4l2
