// The robot's packets: known bytes, round trips of every field, and truncated packets.

#include <gmock/gmock.h>
#include <numeric>
#include <rapidcheck/gtest.h>

#include "drivers/pioneer/config_packet.hpp"
#include "drivers/pioneer/motion_packets.hpp"
#include "tests/drivers/pioneer/stream.hpp"

namespace azimuth::pioneer {
namespace {

using test::ByteVector;
using test::data_of;

template <class Field>
void draw(Field& field) {
  field = *rc::gen::arbitrary<Field>();
}
template <class Field>
void draw(std::optional<Field>& field) {
  field = *rc::gen::arbitrary<Field>();
}
void draw(std::string& field) {
  field = *rc::gen::container<std::string>(rc::gen::inRange('!', '~'));
  field.resize(std::min<std::size_t>(field.size(), 12));
}
template <class... Fields>
void draw_all(Fields&... fields) {
  (draw(fields), ...);
}

/// Fills the first `count` optional fields.
void draw_tail(StandardSip& s, int count) {
  const auto one = [&count](auto& field) {
    if (count-- > 0) draw(field);
  };
  const auto each = [&one](auto&... fields) { (one(fields), ...); };
  each(s.ports.grip_state, s.ports.analog_port, s.ports.analog, s.ports.digital_in, s.ports.digital_out,
       s.battery_x10_decivolts, s.charge_state, s.rotation_ddeg_per_s, s.fault_flags, s.lateral_velocity_mm_per_s,
       s.temperature_C, s.charge_percent, s.time_us, s.flags3);
}

StandardSip any_sip() {
  StandardSip s;
  s.id = *rc::gen::inRange<std::uint8_t>(packet_id::sip_first, packet_id::sip_last + 1);
  draw_all(s.x_units, s.y_units, s.heading_units, s.left_velocity_units, s.right_velocity_units, s.battery_decivolts,
           s.left_stall_and_rear_bumpers, s.right_stall_and_front_bumpers, s.control_units, s.flags, s.compass_2deg);
  s.sonar_count = *rc::gen::inRange<std::uint8_t>(0, 33);
  for (int i = 0; i < s.sonar_count; ++i) draw_all(s.sonars[i].index, s.sonars[i].range_units);
  draw_tail(s, *rc::gen::inRange(0, 15));
  return s;
}

RC_GTEST_PROP(PioneerSip, Survives, ()) {
  const StandardSip sip = any_sip();
  RC_ASSERT(decode_sip(data_of(encode_sip(sip))) == sip);
}

TEST(PioneerSip, EveryFieldHasItsPlace) {
  ByteVector data(1 + 19 + 2 * 3 + 24);
  std::iota(data.begin(), data.end(), std::uint8_t{1});
  data[0] = 0x33;
  data[19] = 2;  // number of sonar readings
  const auto sip = decode_sip(data);
  ASSERT_TRUE(sip);
  EXPECT_EQ(sip->x_units, 0x0302);
  EXPECT_EQ(sip->y_units, 0x0504);
  EXPECT_EQ(sip->heading_units, 0x0706);
  EXPECT_EQ(sip->left_velocity_units, 0x0908);
  EXPECT_EQ(sip->right_velocity_units, 0x0B0A);
  EXPECT_EQ(sip->battery_decivolts, 0x0C);
  EXPECT_EQ(sip->left_stall_and_rear_bumpers, 0x0D);
  EXPECT_EQ(sip->right_stall_and_front_bumpers, 0x0E);
  EXPECT_EQ(sip->control_units, 0x100F);
  EXPECT_EQ(sip->flags, 0x1211);
  EXPECT_EQ(sip->compass_2deg, 0x13);
  EXPECT_EQ(sip->sonars[1], (StandardSip::SonarReading{24, 0x1A19}));
  EXPECT_EQ(sip->ports.grip_state, 27);
  EXPECT_EQ(sip->battery_x10_decivolts, 0x2120);
  EXPECT_EQ(sip->charge_state, 34);
  EXPECT_EQ(sip->rotation_ddeg_per_s, 0x2423);
  EXPECT_EQ(sip->fault_flags, 0x2625);
  EXPECT_EQ(sip->time_us, 0x2E2D2C2BU);
  EXPECT_EQ(sip->flags3, 0x3231302FU);
}

TEST(PioneerSip, StallsBumpersAndFlags) {
  StandardSip sip;
  sip.left_stall_and_rear_bumpers = 0b0000'0101;
  sip.right_stall_and_front_bumpers = 0b1000'0000;
  sip.flags = 0b10'0001;
  EXPECT_TRUE(sip.left_stall());
  EXPECT_FALSE(sip.right_stall());
  EXPECT_EQ(sip.rear_bumpers(), 0b10);
  EXPECT_EQ(sip.front_bumpers(), 0b100'0000);
  EXPECT_TRUE(sip.motors_enabled() && sip.emergency_stop());
  sip.battery_decivolts = 124;
  EXPECT_DOUBLE_EQ(sip.battery_volts(), 12.4);
  sip.battery_x10_decivolts = 262;
  EXPECT_DOUBLE_EQ(sip.battery_volts(), 26.2);
}

TEST(PioneerSip, MayEndAnywhereAfterTheSonarCount) {
  StandardSip sip;
  sip.x_units = 77;
  sip.sonar_count = 3;
  sip.ports.grip_state = sip.ports.analog_port = sip.ports.analog = std::uint8_t{5};
  const ByteVector whole = test::to_vector(data_of(encode_sip(sip)));
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const auto decoded = decode_sip(ByteView(whole).first(size));
    ASSERT_EQ(decoded.has_value(), size >= 20) << size;
    if (!decoded) continue;
    EXPECT_EQ(decoded->x_units, 77);
    EXPECT_EQ(decoded->sonar_count, std::min<std::size_t>(3, (size - 20) / 3));
    EXPECT_EQ(decoded->ports.analog.has_value(), size == whole.size());
  }
}

TEST(PioneerSip, OtherPacketsAreNone) {
  ByteVector data = test::to_vector(data_of(encode_sip({})));
  for (const int id : {0x00, 0x20, 0x2F, 0x35, 0xFF}) {
    data[0] = static_cast<std::uint8_t>(id);
    EXPECT_FALSE(decode_sip(data));
  }
}

ConfigPacket any_config() {
  ConfigPacket c;
  draw_all(c.robot_class, c.subclass, c.serial_number, c.equipment.four_motors, c.top.rotation_deg_per_s, c.name,
           c.sip_cycle_ms, c.baud_codes.host, c.rev_count, c.watchdog_ms, c.limits.velocity_mm_per_s, c.auto_baud,
           c.gyro, c.gyro_factors.drift, c.rotation.kp, c.translation.ki, c.ticks_per_mm, c.battery.shutdown_decivolts,
           c.firmware_version, c.kinematics_delay_ms);
  return c;
}

RC_GTEST_PROP(PioneerConfig, Survives, ()) {
  const ConfigPacket config = any_config();
  RC_ASSERT(decode_config(data_of(encode_config(config))) == config);
}

/// The beginning of a packet from a real P3DX-SH.
const ByteVector& real_config() {
  static const ByteVector data{0x20, 0x50, 0x69, 0x6f, 0x6e, 0x65, 0x65, 0x72, 0x00, 0x70, 0x33, 0x64, 0x78, 0x2d,
                               0x73, 0x68, 0x00, 0x47, 0x4a, 0x43, 0x5f, 0x33, 0x31, 0x35, 0x36, 0x00, 0x00, 0x68,
                               0x01, 0xe8, 0x03, 0x2c, 0x01, 0xd0, 0x07, 0xf4, 0x01, 0x46, 0x41, 0x50, 0x45, 0x53,
                               0x50, 0x5f, 0x33, 0x31, 0x35, 0x36, 0x00, 0x64, 0x00, 0x00, 0x00, 0x00};
  return data;
}

TEST(PioneerConfig, OfARealRobot) {
  const auto config = decode_config(real_config());
  ASSERT_TRUE(config);
  EXPECT_EQ(config->robot_class, "Pioneer");
  EXPECT_EQ(config->subclass, "p3dx-sh");
  EXPECT_EQ(config->serial_number, "GJC_3156");
  EXPECT_EQ(config->top.rotation_deg_per_s, 360);
  EXPECT_EQ(config->top.velocity_mm_per_s, 1000);
  EXPECT_EQ(config->top.rotation_acceleration_deg_per_s2, 300);
  EXPECT_EQ(config->top.acceleration_mm_per_s2, 2000);
  EXPECT_EQ(config->pwm_max, 500);
  EXPECT_EQ(config->name, "FAPESP_3156");
  EXPECT_EQ(config->sip_cycle_ms, 100);
  EXPECT_EQ(config->watchdog_ms, 2000) << "the default, since the packet ends before it";
  EXPECT_TRUE(is_plausible_config(real_config()));
}

TEST(PioneerConfig, EndsEarlyWithoutHarm) {
  const std::size_t required = 50;  // up to the field with the SIP cycle
  for (std::size_t size = 0; size <= real_config().size(); ++size)
    EXPECT_EQ(decode_config(ByteView(real_config()).first(size)).has_value(), size >= required) << size;
}

TEST(PioneerConfig, ImplausibleOnesAreNotBelieved) {
  const auto changed = [](std::size_t at, std::uint8_t value) {
    ByteVector data = real_config();
    data[at] = value;
    return data;
  };
  EXPECT_FALSE(is_plausible_config(changed(0, 0x21)));
  EXPECT_FALSE(is_plausible_config(changed(2, 0x07))) << "unprintable";
  EXPECT_FALSE(is_plausible_config(changed(1, 0x00))) << "no class";
  EXPECT_FALSE(is_plausible_config(changed(28, 0x70))) << "turns too fast";
  EXPECT_FALSE(is_plausible_config(changed(30, 0x70))) << "drives too fast";
  EXPECT_FALSE(is_plausible_config(changed(49, 0x00))) << "no cycle";
  EXPECT_FALSE(is_plausible_config({}));
}

RC_GTEST_PROP(PioneerEncoder, Survives, ()) {
  EncoderPacket encoder;
  draw_all(encoder.left_ticks, encoder.right_ticks);
  RC_ASSERT(decode_encoder(data_of(encode_encoder(encoder))) == encoder);
}

RC_GTEST_PROP(PioneerGyro, Survives, ()) {
  GyroPacket gyro;
  gyro.count = *rc::gen::inRange<std::uint8_t>(0, GyroPacket::kMaxSamples + 1);
  for (int i = 0; i < gyro.count; ++i) draw_all(gyro.samples[i].rate, gyro.samples[i].temperature);
  RC_ASSERT(decode_gyro(data_of(encode_gyro(gyro))) == gyro);
}

TEST(PioneerMotionPackets, HaveTheKnownBytes) {
  EXPECT_EQ(decode_encoder(ByteVector{0x90, 1, 0, 0, 0, 0xFE, 0xFF, 0xFF, 0xFF}), (EncoderPacket{1, -2}));
  EXPECT_FALSE(decode_encoder(ByteVector{0x90, 1, 0, 0, 0, 0xFE, 0xFF, 0xFF}));
  const auto gyro = decode_gyro(ByteVector{0x98, 2, 0x01, 0x02, 20, 0xFF});  // the second sample is truncated
  ASSERT_TRUE(gyro);
  EXPECT_THAT(gyro->all(), testing::ElementsAre(GyroPacket::Sample{0x0201, 20}));
}

RC_GTEST_PROP(PioneerCodecs, AnyBytesDecodeOrNot, ()) {
  auto data = *rc::gen::container<ByteVector>(rc::gen::arbitrary<std::uint8_t>());
  for (const int id : {0x20, 0x32, 0x90, 0x98}) {
    if (!data.empty()) data[0] = static_cast<std::uint8_t>(id);
    decode_sip(data);
    is_plausible_config(data);
    decode_encoder(data);
    const auto gyro = decode_gyro(data);
    if (gyro) RC_ASSERT(gyro->count <= (data.size() - 2) / 3);
  }
}

/// A SIP that is truncated before its sonar count carries no motion, like a packet of another type.
TEST(PioneerMessage, SaysWhatAPacketTellsOfTheMotion) {
  const auto motion = [](const Frame& frame, std::size_t cut = 0) {
    const ByteVector data = data_of(frame);
    return decoded({.data = ByteView(data).first(data.size() - cut), .first_byte_at = {}, .verified = true}).motion;
  };
  StandardSip sip;
  sip.x_units = 1234;
  const EncoderPacket encoder{.left_ticks = -5, .right_ticks = 7};
  GyroPacket gyro{.count = 1, .samples = {}};
  gyro.samples[0] = {.rate = 512, .temperature = 20};
  EXPECT_EQ(std::get<StandardSip>(motion(encode_sip(sip))), sip);
  EXPECT_EQ(std::get<EncoderPacket>(motion(encode_encoder(encoder))), encoder);
  EXPECT_EQ(std::get<GyroPacket>(motion(encode_gyro(gyro))), gyro);
  EXPECT_EQ(motion(encode_sip(sip), 1).index(), 0U);
  EXPECT_EQ(motion(encode_command(Command::pulse)).index(), 0U);
}

}  // namespace
}  // namespace azimuth::pioneer
