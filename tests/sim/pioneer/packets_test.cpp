#include "sim/pioneer/packets.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

namespace azimuth::sim {
namespace {

using testing::ElementsAre;

Bytes bytes_of(const pioneer::Frame& frame) { return {frame.bytes.data(), frame.bytes.data() + frame.size}; }
Bytes data_of(const pioneer::Frame& frame) { return {frame.bytes.data() + 3, frame.bytes.data() + frame.size - 2}; }

/// Reads a packet's data field by field, in the order of the protocol description.
class FieldReader {
 public:
  explicit FieldReader(const pioneer::Frame& frame) : data_(data_of(frame)) {}
  int u8() { return data_.at(next_++); }
  int u16() {
    const int low = u8();
    return low | (u8() << 8);
  }
  std::string text() {
    std::string text;
    while (const int letter = u8()) text += static_cast<char>(letter);
    return text;
  }
  void skip_u16(int count) { next_ += 2 * static_cast<std::size_t>(count); }
  bool at_end() const { return next_ == data_.size(); }

 private:
  Bytes data_;
  std::size_t next_ = 0;
};

TEST(Packets, EchoesAreTheBytesOfTheDescription) {
  EXPECT_THAT(bytes_of(bare_packet(0)), ElementsAre(0xFA, 0xFB, 3, 0, 0, 0));
  EXPECT_THAT(bytes_of(bare_packet(1)), ElementsAre(0xFA, 0xFB, 3, 1, 0, 1));
}

TEST(Packets, NamesAreThreeTerminatedStrings) {
  FieldReader reader(names_packet(PioneerModel{}));
  EXPECT_EQ(reader.u8(), 2);
  EXPECT_EQ(reader.text(), "Azimuth_sim");
  EXPECT_EQ(reader.text(), "Pioneer");
  EXPECT_EQ(reader.text(), "p3dx-sh");
  EXPECT_TRUE(reader.at_end());
}

TEST(Packets, SipsHaveTheLengthsOfTheDescription) {
  SipFields fields;
  EXPECT_EQ(sip_packet(fields).size, 41U);
  const std::vector<SonarReading> sonar(16);
  fields.sonar = sonar;
  EXPECT_EQ(sip_packet(fields).size, 89U);
}

TEST(Packets, SipHoldsItsFieldsAtTheirOffsets) {
  SipFields fields;
  fields.id = 0x33;
  fields.x = 0x1234;
  fields.y = 0xFEDC;
  fields.heading = -2048;
  fields.left_velocity = -300;
  fields.right_velocity = 400;
  fields.battery_v = 12.7;
  fields.left_stall_bumpers = 0x81;
  fields.right_stall_bumpers = 0x02;
  fields.flags = 0x0023;
  const std::vector<SonarReading> sonar{{5, 5000}};
  fields.sonar = sonar;
  fields.rotation_velocity_ddeg_per_s = -15;
  EXPECT_THAT(data_of(sip_packet(fields)),
              ElementsAre(0x33, 0x34, 0x12, 0xDC, 0xFE, 0x00, 0xF8, 0xD4, 0xFE, 0x90, 0x01, 127, 0x81, 0x02, 0, 0, 0x23,
                          0x00, 0, 1, 5, 0x88, 0x13, 0, 0, 0, 0, 0, 127, 0, 0, 0xF1, 0xFF, 0, 0, 0, 0, 0x81, 0));
}

TEST(Packets, EncodersAreTwoSignedCounts) {
  EXPECT_THAT(data_of(encoder_packet(-2, 0x01020304)), ElementsAre(0x90, 0xFE, 0xFF, 0xFF, 0xFF, 4, 3, 2, 1));
}

TEST(Packets, GyroSamplesAreCountedRatesAndTemperatures) {
  const std::vector<GyroSample> samples{{513, 25}, {511, 26}};
  EXPECT_THAT(data_of(gyro_packet(samples)), ElementsAre(0x98, 2, 0x01, 0x02, 25, 0xFF, 0x01, 26));
}

TEST(Packets, ConfigurationHasItsFieldsInOrder) {
  PioneerModel model;
  model.has_gyro = true;
  FieldReader reader(config_packet(model, model.usual, 4));
  EXPECT_EQ(reader.u8(), 0x20);
  EXPECT_EQ(reader.text(), "Pioneer");
  EXPECT_EQ(reader.text(), "p3dx-sh");
  EXPECT_EQ(reader.text(), "SIM_0001");
  EXPECT_EQ(reader.u8(), 0);     // 4mots
  EXPECT_EQ(reader.u16(), 360);  // rotVelTop
  EXPECT_EQ(reader.u16(), 1000);
  EXPECT_EQ(reader.u16(), 300);
  EXPECT_EQ(reader.u16(), 2000);
  EXPECT_EQ(reader.u16(), 500);  // pwmMax
  EXPECT_EQ(reader.text(), "Azimuth_sim");
  EXPECT_EQ(reader.u8(), 100);  // sipCycle
  EXPECT_EQ(reader.u8(), 4);    // hostBaud
  EXPECT_EQ(reader.u8(), 0);    // aux1Baud
  EXPECT_EQ(reader.u16(), 0);   // hasGripper
  EXPECT_EQ(reader.u16(), 1);   // frontSonar
  EXPECT_EQ(reader.u8(), 1);    // rearSonar
  EXPECT_EQ(reader.u16(), 110);
  EXPECT_EQ(reader.u16(), 16570);
  EXPECT_EQ(reader.u16(), 2000);  // watchdog
  EXPECT_EQ(reader.u8(), 0);
  reader.skip_u16(4);             // stallVal, stallCount, joyVel, joyRotVel
  EXPECT_EQ(reader.u16(), 360);   // rotVelMax
  EXPECT_EQ(reader.u16(), 1000);  // transVelMax
  reader.skip_u16(10);            // rotAcc to transKi
  EXPECT_EQ(reader.u16(), 0);     // bumpers
  EXPECT_EQ(reader.u8(), 0);      // charger
  EXPECT_EQ(reader.u8(), 40);     // sonarCycle
  EXPECT_EQ(reader.u8(), 2);      // autobaud
  EXPECT_EQ(reader.u8(), 1);      // gyro
  EXPECT_EQ(reader.u16(), 0);     // driftFactor
  EXPECT_EQ(reader.u16(), 0);     // aux2Baud, aux3Baud
  EXPECT_EQ(reader.u16(), 128);   // ticksMM
  EXPECT_EQ(reader.u16(), 105);   // shutdownVolts
  EXPECT_EQ(reader.text(), "2.6");
  reader.skip_u16(2);
  EXPECT_EQ(reader.u8(), 0);  // kinematicsDelay
  EXPECT_TRUE(reader.at_end());
}

}  // namespace
}  // namespace azimuth::sim
