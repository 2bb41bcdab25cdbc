// Image format 7 and the features of the stand-in.

#include <algorithm>

#include "tests/drivers/iidc/fake_dc1394.hpp"

using azimuth::test::fake;
using azimuth::test::FakeFeature;

extern "C" {

// Format 7.

dc1394error_t dc1394_format7_get_color_codings(dc1394camera_t* /*camera*/, dc1394video_mode_t /*mode*/,
                                               dc1394color_codings_t* codings) {
  FAKE_CALL();
  codings->num = 0;
  for (const auto coding : fake().format7.codings) codings->codings[codings->num++] = coding;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_set_color_coding(dc1394camera_t* /*camera*/, dc1394video_mode_t /*mode*/,
                                              dc1394color_coding_t coding) {
  FAKE_CALL();
  fake().format7.coding = coding;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_get_color_filter(dc1394camera_t* /*camera*/, dc1394video_mode_t /*mode*/,
                                              dc1394color_filter_t* filter) {
  FAKE_CALL();
  *filter = fake().format7.filter;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_get_max_image_size(dc1394camera_t* /*camera*/, dc1394video_mode_t /*mode*/,
                                                uint32_t* width, uint32_t* height) {
  FAKE_CALL();
  *width = fake().format7.max_width;
  *height = fake().format7.max_height;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_get_unit_size(dc1394camera_t* /*camera*/, dc1394video_mode_t /*mode*/, uint32_t* width,
                                           uint32_t* height) {
  FAKE_CALL();
  *width = fake().format7.unit_width;
  *height = fake().format7.unit_height;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_get_unit_position(dc1394camera_t* /*camera*/, dc1394video_mode_t /*mode*/, uint32_t* left,
                                               uint32_t* top) {
  FAKE_CALL();
  *left = fake().format7.unit_left;
  *top = fake().format7.unit_top;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_set_roi(dc1394camera_t* /*camera*/, dc1394video_mode_t mode, dc1394color_coding_t coding,
                                     int32_t packet_size, int32_t left, int32_t top, int32_t width, int32_t height) {
  FAKE_CALL();
  azimuth::test::FakeFormat7& is = fake().format7;
  const auto wrong = [](int32_t value, uint32_t unit) {
    return value < 0 || static_cast<uint32_t>(value) % std::max(unit, 1U) != 0;
  };
  if (mode != fake().mode || wrong(left, is.unit_left) || wrong(top, is.unit_top) || wrong(width, is.unit_width) ||
      wrong(height, is.unit_height) || static_cast<uint32_t>(left + width) > is.max_width ||
      static_cast<uint32_t>(top + height) > is.max_height)
    return DC1394_FORMAT7_ERROR_FLAG_1;
  is.coding = coding;
  is.left = static_cast<uint32_t>(left);
  is.top = static_cast<uint32_t>(top);
  is.width = static_cast<uint32_t>(width);
  is.height = static_cast<uint32_t>(height);
  const uint32_t packet = packet_size == DC1394_USE_RECOMMENDED
                              ? is.packet_recommended
                              : std::min(static_cast<uint32_t>(packet_size), is.packet_max);
  is.packet = packet - packet % is.packet_unit;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_get_roi(dc1394camera_t* /*camera*/, dc1394video_mode_t /*mode*/,
                                     dc1394color_coding_t* coding, uint32_t* packet_size, uint32_t* left, uint32_t* top,
                                     uint32_t* width, uint32_t* height) {
  FAKE_CALL();
  const azimuth::test::FakeFormat7& is = fake().format7;
  *coding = is.coding;
  *packet_size = is.packet;
  *left = is.left;
  *top = is.top;
  *width = is.width;
  *height = is.height;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_get_packet_parameters(dc1394camera_t* /*camera*/, dc1394video_mode_t /*mode*/,
                                                   uint32_t* unit, uint32_t* max) {
  FAKE_CALL();
  *unit = fake().format7.packet_unit;
  *max = fake().format7.packet_max;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_set_packet_size(dc1394camera_t* /*camera*/, dc1394video_mode_t /*mode*/, uint32_t bytes) {
  FAKE_CALL();
  fake().format7.packet = bytes;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_get_packets_per_frame(dc1394camera_t* /*camera*/, dc1394video_mode_t /*mode*/,
                                                   uint32_t* packets) {
  FAKE_CALL();
  const azimuth::test::FakeFormat7& is = fake().format7;
  *packets = is.packet == 0 ? 0 : (is.width * is.height + is.packet - 1) / is.packet;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_format7_get_frame_interval(dc1394camera_t* /*camera*/, dc1394video_mode_t /*mode*/,
                                                float* interval_s) {
  FAKE_CALL();
  *interval_s = fake().format7.interval_s;
  return DC1394_SUCCESS;
}

// Features.

dc1394error_t dc1394_feature_get(dc1394camera_t* /*camera*/, dc1394feature_info_t* info) {
  FAKE_CALL();
  const auto found = fake().features.find(info->id);
  info->available = DC1394_FALSE;
  if (found == fake().features.end() || !found->second.available) return DC1394_SUCCESS;
  const FakeFeature& is = found->second;
  const auto as_bool = [](bool value) { return value ? DC1394_TRUE : DC1394_FALSE; };
  info->available = DC1394_TRUE;
  info->on_off_capable = as_bool(is.switchable);
  info->absolute_capable = as_bool(is.absolute);
  info->is_on = is.on ? DC1394_ON : DC1394_OFF;
  info->modes.num = 1;
  info->modes.modes[0] = DC1394_FEATURE_MODE_MANUAL;
  if (is.automatic) info->modes.modes[info->modes.num++] = DC1394_FEATURE_MODE_AUTO;
  info->min = is.min;
  info->max = is.max;
  info->abs_min = is.abs_min;
  info->abs_max = is.abs_max;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_set_power(dc1394camera_t* /*camera*/, dc1394feature_t id, dc1394switch_t on) {
  FAKE_CALL();
  fake().features[id].on = on == DC1394_ON;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_get_power(dc1394camera_t* /*camera*/, dc1394feature_t id, dc1394switch_t* on) {
  FAKE_CALL();
  *on = fake().features[id].on ? DC1394_ON : DC1394_OFF;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_set_mode(dc1394camera_t* /*camera*/, dc1394feature_t id, dc1394feature_mode_t mode) {
  FAKE_CALL();
  fake().features[id].mode = mode;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_get_mode(dc1394camera_t* /*camera*/, dc1394feature_t id, dc1394feature_mode_t* mode) {
  FAKE_CALL();
  *mode = fake().features[id].mode;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_set_absolute_control(dc1394camera_t* /*camera*/, dc1394feature_t id, dc1394switch_t on) {
  FAKE_CALL();
  fake().features[id].uses_absolute = on == DC1394_ON;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_set_absolute_value(dc1394camera_t* /*camera*/, dc1394feature_t id, float value) {
  FAKE_CALL();
  fake().features[id].abs_value = value;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_get_absolute_value(dc1394camera_t* /*camera*/, dc1394feature_t id, float* value) {
  FAKE_CALL();
  *value = fake().features[id].abs_value;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_set_value(dc1394camera_t* /*camera*/, dc1394feature_t id, uint32_t value) {
  FAKE_CALL();
  FakeFeature& feature = fake().features[id];
  if (value < feature.min || value > feature.max) return DC1394_REQ_VALUE_OUTSIDE_RANGE;
  feature.value = value - value % feature.step;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_get_value(dc1394camera_t* /*camera*/, dc1394feature_t id, uint32_t* value) {
  FAKE_CALL();
  *value = fake().features[id].value;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_whitebalance_set_value(dc1394camera_t* /*camera*/, uint32_t blue, uint32_t red) {
  FAKE_CALL();
  FakeFeature& feature = fake().features[DC1394_FEATURE_WHITE_BALANCE];
  feature.value = blue;
  feature.second_value = red;
  return DC1394_SUCCESS;
}
dc1394error_t dc1394_feature_whitebalance_get_value(dc1394camera_t* /*camera*/, uint32_t* blue, uint32_t* red) {
  FAKE_CALL();
  const FakeFeature& feature = fake().features[DC1394_FEATURE_WHITE_BALANCE];
  *blue = feature.value;
  *red = feature.second_value;
  return DC1394_SUCCESS;
}

}  // extern "C"
