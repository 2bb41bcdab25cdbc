// Settings of an LCM source that are refused, above all those that would feed the daemon its own messages.

#include <gmock/gmock.h>

#include "daemon/config/daemon_settings.hpp"

namespace azimuth {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> wrong_keys(const DaemonSettings& settings) {
  std::vector<std::string> keys;
  for (const FileError& violation : check(settings)) keys.push_back(violation.file);
  return keys;
}

TEST(LcmSourceSettings, OwnChannelsAreRefused) {
  for (const char* own : {"AZIMUTH_POSE", "POSE", "AZIMUTH_MAP_CHUNK", "AZIMUTH_PATH", "AZIMUTH_STATUS",
                          "AZIMUTH_PICTURE", "AZIMUTH_ODOM", "AZIMUTH_BEARINGS", "AZIMUTH_FEATURES",
                          "AZIMUTH_SIGHTINGS", "AZIMUTH_EXPECTED", "AZIMUTH_KEPT"}) {
    DaemonSettings settings;
    settings.live.lcm.odometry_channel = own;
    EXPECT_THAT(wrong_keys(settings), ElementsAre("daemon.lcm_source.odometry_channel")) << own;
    settings.live.lcm.odometry_channel = "ODOMETRY";
    settings.live.lcm.frames_channel = own;
    EXPECT_THAT(wrong_keys(settings), ElementsAre("daemon.lcm_source.frames_channel")) << own;
  }
}

TEST(LcmSourceSettings, WithAPrefixTheOwnChannelsHaveOtherNames) {
  DaemonSettings settings;
  settings.publish.channel_prefix = "ROBOT_";
  settings.live.lcm.odometry_channel = "AZIMUTH_ODOM";
  EXPECT_THAT(wrong_keys(settings), IsEmpty());
  settings.live.lcm.odometry_channel = "ROBOT_AZIMUTH_ODOM";
  EXPECT_THAT(wrong_keys(settings), ElementsAre("daemon.lcm_source.odometry_channel"));
}

TEST(LcmSourceSettings, WhatIsNotSentOrSentElsewhereMayBeHeard) {
  DaemonSettings settings;
  settings.live.lcm.odometry_channel = "AZIMUTH_ODOM";
  settings.publish.echo_samples = false;
  EXPECT_THAT(wrong_keys(settings), IsEmpty());
  settings.publish.echo_samples = true;
  settings.publish.lcm_url = "udpm://239.255.76.68:7667?ttl=0";
  EXPECT_THAT(wrong_keys(settings), IsEmpty());
  settings.live.lcm.url = "udpm://239.255.76.68";
  EXPECT_THAT(wrong_keys(settings), ElementsAre("daemon.lcm_source.odometry_channel"))
      << "the same place, said otherwise";
}

TEST(LcmSourceSettings, ChannelsAndPlacesThatCannotBeAreRefused) {
  DaemonSettings settings;
  settings.live.lcm.url = "tcpq://localhost";
  settings.live.lcm.frames_channel = "";
  settings.live.lcm.odometry_channel = std::string(64, 'x');
  EXPECT_THAT(wrong_keys(settings), ElementsAre("daemon.lcm_source.url", "daemon.lcm_source.frames_channel",
                                                "daemon.lcm_source.odometry_channel"));
  settings = {};
  settings.live.lcm.odometry_channel = "CAMERA";
  EXPECT_THAT(wrong_keys(settings), ElementsAre("daemon.lcm_source.odometry_channel"));
}

}  // namespace
}  // namespace azimuth
