#include "tests/tools/doctor/fake_machine.hpp"
#include "tools/doctor/device_access.hpp"

namespace azimuth {
namespace {

using test::IsFinding;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class DeviceChecks : public test::FakeMachine {};

TEST_F(DeviceChecks, AccessIsByOwnerGroupAndOthersInThatOrder) {
  const test::fs::path file = write("/dev/x", "", 0060);
  EXPECT_EQ(access_to(machine, machine.at("/dev/y")), Access::missing);
  EXPECT_EQ(access_to(machine, file), Access::denied);
  ::chmod(file.c_str(), 0006);
  EXPECT_EQ(access_to(machine, file), Access::granted);
  join_files_group();
  EXPECT_EQ(access_to(machine, file), Access::denied) << "the group's mode counts, not that of others";
  ::chmod(file.c_str(), 0060);
  EXPECT_EQ(access_to(machine, file), Access::granted);
  ::chmod(file.c_str(), 0040);
  EXPECT_EQ(access_to(machine, file), Access::denied) << "reading is not enough";
  machine.account.uid = ::geteuid();
  if (machine.account.uid != 0) {
    EXPECT_EQ(access_to(machine, file), Access::denied) << "the owner's mode counts";
  }
  machine.account.uid = 0;
  EXPECT_EQ(access_to(machine, file), Access::granted);
}

TEST_F(DeviceChecks, AdaptersAreFoundInTheOrderOfTheirNumbers) {
  for (const char* name : {"/dev/ttyUSB10", "/dev/ttyUSB2", "/dev/ttyACM0", "/dev/ttyS0", "/dev/null"}) write(name);
  EXPECT_THAT(serial_devices(machine), ElementsAre("/dev/ttyUSB2", "/dev/ttyUSB10", "/dev/ttyACM0"));
}

TEST_F(DeviceChecks, SerialDeviceMissing) {
  const Finding finding = check_serial_device(machine, "/dev/ttyUSB0");
  EXPECT_THAT(finding, IsFinding(Verdict::error, "/dev/ttyUSB0 is not there"));
  EXPECT_THAT(finding.fix, HasSubstr("by-id"));
  EXPECT_EQ(check_serial(machine, "/dev/ttyUSB0").size(), 1U) << "nothing more to be said about it";
}

TEST_F(DeviceChecks, ALinkToNowhereIsMissing) {
  link("/dev/pioneer", "ttyUSB0");
  EXPECT_THAT(check_serial_device(machine, "/dev/pioneer"), IsFinding(Verdict::error, "not there"));
}

TEST_F(DeviceChecks, SerialDeviceDenied) {
  write("/dev/ttyUSB0", "", 0660);
  const Finding finding = check_serial_device(machine, "/dev/ttyUSB0");
  EXPECT_THAT(finding, IsFinding(Verdict::error, "ada may not read and write /dev/ttyUSB0"));
  if (file_group() == 0) {
    EXPECT_THAT(finding.fix, HasSubstr("chgrp dialout")) << "nobody is to join root's group";
  } else {
    EXPECT_THAT(finding.fix, HasSubstr("sudo usermod -aG video ada"));
  }
}

TEST_F(DeviceChecks, SerialDeviceGrantedThroughALink) {
  write("/dev/ttyUSB0", "", 0666);
  link("/dev/pioneer", "ttyUSB0");
  EXPECT_THAT(check_serial_device(machine, "/dev/pioneer"), IsFinding(Verdict::ok, "/dev/pioneer is there"));
}

TEST_F(DeviceChecks, JoiningAGroupThatWasJoinedMeansLoggingIn) {
  EXPECT_THAT(join_group(machine, 20), HasSubstr("sudo usermod -aG dialout ada"));
  machine.account.groups.push_back(20);
  EXPECT_EQ(join_group(machine, 20), "# log out and in again: then the new groups count");
}

TEST_F(DeviceChecks, SerialDeviceHeldByAnother) {
  write("/dev/ttyUSB0");
  link("/dev/pioneer", "ttyUSB0");
  process(12, "bash", "/dev/pts/0");
  EXPECT_THAT(check_serial_users(machine, "/dev/pioneer"), IsFinding(Verdict::ok, "nobody this user can see"));
  process(4711, "minicom", "/dev/ttyUSB0");
  const Finding finding = check_serial_users(machine, "/dev/pioneer");
  EXPECT_THAT(finding, IsFinding(Verdict::error, "used by minicom (process 4711)"));
  EXPECT_EQ(finding.fix, "kill 4711");
}

TEST_F(DeviceChecks, TheDaemonItselfMayHoldTheDevice) {
  process(7, "azimuthd", "/dev/ttyUSB0");
  EXPECT_THAT(check_serial_users(machine, "/dev/ttyUSB0"), IsFinding(Verdict::ok, "used by azimuthd"));
}

TEST_F(DeviceChecks, LockFilesCountWhileTheirProcessLives) {
  write("/var/lock/LCK..ttyUSB0", "       312\n");
  EXPECT_THAT(check_serial_users(machine, "/dev/ttyUSB0"), IsFinding(Verdict::ok, ""));
  process(312, "kermit");
  EXPECT_THAT(check_serial_users(machine, "/dev/ttyUSB0"), IsFinding(Verdict::error, "locked by process 312"));
}

TEST_F(DeviceChecks, LatencyTimerOfFtdiAdapters) {
  EXPECT_THAT(check_latency_timer(machine, "/dev/ttyUSB0"), IsEmpty()) << "another make has none";
  const std::string file = "/sys/bus/usb-serial/devices/ttyUSB0/latency_timer";
  write(file, "16\n");
  link("/dev/pioneer", "ttyUSB0");
  const Findings slow = check_latency_timer(machine, "/dev/pioneer");
  EXPECT_THAT(slow, ElementsAre(IsFinding(Verdict::warning, "up to 16 ms")));
  EXPECT_THAT(slow[0].fix, HasSubstr("echo 1 | sudo tee " + file));
  EXPECT_THAT(slow[0].fix, HasSubstr("ATTR{latency_timer}=\"1\""));
  write(file, "1\n");
  EXPECT_THAT(check_latency_timer(machine, "/dev/pioneer"), ElementsAre(IsFinding(Verdict::ok, "within 1 ms")));
}

TEST_F(DeviceChecks, ModemManagerUnlessToldToLeaveTheDeviceAlone) {
  EXPECT_THAT(check_modem_manager(machine, "/dev/ttyUSB0"), IsEmpty());
  process(99, "ModemManager");
  EXPECT_THAT(check_modem_manager(machine, "/dev/ttyUSB0"), ElementsAre(IsFinding(Verdict::warning, "process 99")));
  write("/sys/class/tty/ttyUSB0/dev", "188:0\n");
  write("/run/udev/data/c188:0", "E:ID_BUS=usb\nE:ID_MM_DEVICE_IGNORE=1\n");
  EXPECT_THAT(check_modem_manager(machine, "/dev/ttyUSB0"), ElementsAre(IsFinding(Verdict::ok, "leave")));
}

TEST_F(DeviceChecks, RobotsBehindTcpHaveNoSerialDevice) {
  EXPECT_THAT(check_serial(machine, "tcp:127.0.0.1:8101"), IsEmpty());
}

TEST_F(DeviceChecks, EveryTopicOfADeviceIsLookedAt) {
  write("/dev/ttyUSB0", "", 0666);
  write("/sys/bus/usb-serial/devices/ttyUSB0/latency_timer", "1");
  process(99, "ModemManager");
  std::vector<std::string> topics;
  for (const Finding& finding : check_serial(machine, "/dev/ttyUSB0")) topics.push_back(finding.check);
  EXPECT_THAT(topics, ElementsAre("serial", "serial", "latency", "modems"));
}

TEST_F(DeviceChecks, Groups) {
  EXPECT_THAT(check_group(machine, "wheel"), IsFinding(Verdict::unknown, "no group wheel"));
  const Finding outside = check_group(machine, "dialout");
  EXPECT_THAT(outside, IsFinding(Verdict::warning, "ada is not in group dialout"));
  EXPECT_THAT(outside.fix, HasSubstr("sudo usermod -aG dialout ada"));
  machine.account.groups.push_back(20);
  EXPECT_THAT(check_group(machine, "dialout"), IsFinding(Verdict::warning, "after this session began"));
  machine.account.groups_here.push_back(20);
  EXPECT_THAT(check_group(machine, "dialout"), IsFinding(Verdict::ok, "ada is in group dialout"));
  machine.account = {"root", 0, {0}, {0}};
  EXPECT_THAT(check_group(machine, "dialout"), IsFinding(Verdict::ok, "root"));
}

}  // namespace
}  // namespace azimuth
