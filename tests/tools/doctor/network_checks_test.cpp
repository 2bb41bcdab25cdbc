#include "tests/tools/doctor/fake_machine.hpp"

namespace azimuth {
namespace {

using test::IsFinding;
using testing::HasSubstr;

class NetworkChecks : public test::FakeMachine {
 protected:
  /// Writes the routing table as the kernel prints it on a little-endian machine.
  void routes(const std::string& lines) {
    write("/proc/net/route",
          "Iface\tDestination\tGateway \tFlags\tRefCnt\tUse\tMetric\tMask\t\tMTU\tWindow\tIRTT\n" + lines);
  }
  static constexpr const char* kDefault = "eth0\t00000000\t0102A8C0\t0003\t0\t0\t0\t00000000\t0\t0\t0\n";
  static constexpr const char* kLan = "eth0\t0002A8C0\t00000000\t0001\t0\t0\t0\t00FFFFFF\t0\t0\t0\n";
  static constexpr const char* kMulticast = "lo\t000000E0\t00000000\t0001\t0\t0\t0\t000000F0\t0\t0\t0\n";
  static constexpr const char* kGroup = "wlan0\t434CFFEF\t00000000\t0005\t0\t0\t0\tFFFFFFFF\t0\t0\t0\n";
  static constexpr const char* kGroupDown = "wlan0\t434CFFEF\t00000000\t0004\t0\t0\t0\tFFFFFFFF\t0\t0\t0\n";
};

TEST_F(NetworkChecks, RouteUnknown) { EXPECT_THAT(check_multicast_route(machine), IsFinding(Verdict::unknown, "")); }

TEST_F(NetworkChecks, NoRoute) {
  for (const std::string table : {"", kLan, kGroupDown, "rubbish\n\n"}) {
    routes(table);
    const Finding finding = check_multicast_route(machine);
    EXPECT_THAT(finding, IsFinding(Verdict::error, "no route to LCM's group")) << table;
    EXPECT_THAT(finding.fix, HasSubstr("sudo ip route add 239.255.76.67/32 dev lo"));
  }
}

TEST_F(NetworkChecks, RouteThroughTheLan) {
  routes(std::string(kLan) + kDefault);
  const Finding finding = check_multicast_route(machine);
  EXPECT_THAT(finding, IsFinding(Verdict::warning, "goes through eth0"));
  EXPECT_THAT(finding.fix, HasSubstr("dev lo"));
}

TEST_F(NetworkChecks, TheNarrowestRouteCounts) {
  routes(std::string(kMulticast) + kDefault);
  EXPECT_THAT(check_multicast_route(machine), IsFinding(Verdict::ok, "through lo"));
  routes(std::string(kGroup) + kMulticast + kDefault);
  EXPECT_THAT(check_multicast_route(machine), IsFinding(Verdict::warning, "through wlan0"));
  routes(std::string(kGroupDown) + kMulticast + kDefault);
  EXPECT_THAT(check_multicast_route(machine), IsFinding(Verdict::ok, "through lo"));
}

TEST_F(NetworkChecks, Loopback) {
  EXPECT_THAT(check_loopback_multicast(machine), IsFinding(Verdict::unknown, "cannot be read"));
  routes(kMulticast);
  write("/sys/class/net/lo/flags", "0x8\n");
  EXPECT_THAT(check_loopback_multicast(machine), IsFinding(Verdict::error, "lo is down"));
  write("/sys/class/net/lo/flags", "0x9\n");
  const Finding finding = check_loopback_multicast(machine);
  EXPECT_THAT(finding, IsFinding(Verdict::error, "lo carries no multicast"));
  EXPECT_EQ(finding.fix, "sudo ip link set lo multicast on");
  routes(kDefault);
  EXPECT_THAT(check_loopback_multicast(machine), IsFinding(Verdict::ok, "does not need it"));
  write("/sys/class/net/lo/flags", "0x1009\n");
  EXPECT_THAT(check_loopback_multicast(machine), IsFinding(Verdict::ok, "lo carries multicast"));
}

TEST_F(NetworkChecks, ReceiveBuffers) {
  EXPECT_THAT(check_receive_buffer(machine, "rmem_max"), IsFinding(Verdict::unknown, "net.core.rmem_max"));
  write("/proc/sys/net/core/rmem_max", "212992\n");
  const Finding small = check_receive_buffer(machine, "rmem_max");
  EXPECT_THAT(small, IsFinding(Verdict::warning, "net.core.rmem_max is 208 kB"));
  EXPECT_THAT(small.fix, HasSubstr("sudo sysctl -w net.core.rmem_max=2097152"));
  write("/proc/sys/net/core/rmem_max", "2097152\n");
  EXPECT_THAT(check_receive_buffer(machine, "rmem_max"), IsFinding(Verdict::ok, "2048 kB"));
}

}  // namespace
}  // namespace azimuth
