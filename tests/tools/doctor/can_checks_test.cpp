#include "tests/tools/doctor/fake_machine.hpp"

namespace azimuth {
namespace {

using test::IsFinding;
using testing::ElementsAre;
using testing::HasSubstr;

class CanChecks : public test::FakeMachine {
 protected:
  void interface(const std::string& name, bool is_up, const std::string& type = "280") {
    write("/sys/class/net/" + name + "/type", type + "\n");
    write("/sys/class/net/" + name + "/flags", is_up ? "0x40081\n" : "0x40080\n");
  }
  /// Sets the output of the program `ip`.
  void ip_says(const std::string& output) {
    machine.run = [output](const std::vector<std::string>& command) {
      return command[0] == "ip" ? std::optional(ProgramOutcome{0, output}) : std::nullopt;
    };
  }
  void can0_is(const std::string& state, int bit_rate) {
    ip_says(R"([{"ifname":"lo","link_type":"loopback"},{"ifname":"can0","link_type":"can","linkinfo":{)"
            R"("info_kind":"can","info_data":{"state":")" +
            state + R"(","bittiming":{"bitrate":)" + std::to_string(bit_rate) + R"(,"sample_point":"0.875"}}}}])");
  }
  Findings check(const std::string& interface) {
    Plan plan;
    plan.can_interface = interface;
    return check_can(machine, plan);
  }
};

TEST_F(CanChecks, NoneIsNoErrorUnlessOneIsConfigured) {
  interface("eth0", true, "1");
  EXPECT_THAT(check_can(machine, {}), ElementsAre(IsFinding(Verdict::ok, "there is no CAN interface")));
  const Findings missing = check("can0");
  EXPECT_THAT(missing, ElementsAre(IsFinding(Verdict::error, "the configured CAN interface, can0, is not there")));
  EXPECT_THAT(missing[0].fix, HasSubstr("dmesg"));
  const Findings missing_virtual = check("vcan3");
  EXPECT_THAT(missing_virtual, ElementsAre(IsFinding(Verdict::error, "vcan3, is not there")));
  EXPECT_THAT(missing_virtual[0].fix, HasSubstr("ip link add vcan3 type vcan")) << "no adapter can be plugged in";
}

TEST_F(CanChecks, AnInterfaceThatIsUpIsShownWithItsBitRate) {
  interface("can0", true);
  EXPECT_THAT(check("can0"), ElementsAre(IsFinding(Verdict::ok, "can0 is up, bit rate not known")));
  can0_is("ERROR-ACTIVE", 250000);
  EXPECT_THAT(check("can0"), ElementsAre(IsFinding(Verdict::ok, "can0 is up, 250000 bit/s, ERROR-ACTIVE")));
  ip_says(R"([{"ifname":"can0","linkinfo":{"info_kind":"can","info_data":{"bitrate":83333}}}])");
  EXPECT_THAT(check("can0"), ElementsAre(IsFinding(Verdict::ok, "83333 bit/s"))) << "of hardware with fixed rates";
}

TEST_F(CanChecks, AnInterfaceThatIsDownIsSwitchedOn) {
  interface("can0", false);
  const Findings down = check("can0");
  EXPECT_THAT(down, ElementsAre(IsFinding(Verdict::error, "can0 is down")));
  EXPECT_THAT(down[0].fix, HasSubstr("type can bitrate"));
  EXPECT_THAT(down[0].fix, HasSubstr("sudo ip link set can0 up"));
  can0_is("STOPPED", 500000);
  EXPECT_EQ(check("can0")[0].fix, "sudo ip link set can0 up") << "its bit rate is set already";
  EXPECT_THAT(check_can(machine, {}), ElementsAre(IsFinding(Verdict::warning, "can0 is down")))
      << "it may be meant, but nobody says so";
  Plan other;
  other.devices = {"/dev/pioneer"};
  EXPECT_THAT(check_can(machine, other),
              ElementsAre(IsFinding(Verdict::ok, "can0 is down, 500000 bit/s; it is not used")));
}

TEST_F(CanChecks, VirtualInterfacesHaveNoBitRate) {
  interface("vcan0", false);
  ip_says(R"([{"ifname":"vcan0","linkinfo":{"info_kind":"vcan"}}])");
  const Findings down = check("vcan0");
  EXPECT_THAT(down, ElementsAre(IsFinding(Verdict::error, "vcan0 is down, virtual")));
  EXPECT_EQ(down[0].fix, "sudo ip link set vcan0 up");
  interface("vcan0", true);
  EXPECT_THAT(check("vcan0"), ElementsAre(IsFinding(Verdict::ok, "vcan0 is up, virtual")));
}

TEST_F(CanChecks, AControllerInTroubleIsTold) {
  interface("can0", true);
  can0_is("BUS-OFF", 500000);
  const Findings off = check("can0");
  EXPECT_THAT(off, ElementsAre(IsFinding(Verdict::warning, "takes no part in the bus")));
  EXPECT_THAT(off[0].fix, HasSubstr("type can restart"));
  can0_is("ERROR-PASSIVE", 500000);
  EXPECT_THAT(check("can0"), ElementsAre(IsFinding(Verdict::warning, "many errors")));
}

TEST_F(CanChecks, OtherInterfacesAreShownBesideTheConfiguredOne) {
  interface("can0", true);
  interface("can1", true);
  EXPECT_THAT(check("can1"),
              ElementsAre(IsFinding(Verdict::ok, "can1 is up"), IsFinding(Verdict::ok, "it is not used")));
}

TEST_F(CanChecks, WhateverIpSaysIsSafe) {
  interface("can0", true);
  for (const char* odd : {"", "null", "{}", "[1]", "[[]]", R"([{"ifname":7}])", R"([{"ifname":"can0"}])", "[{",
                          R"([{"ifname":"can0","linkinfo":[]}])", R"([{"ifname":"can0","linkinfo":{"info_kind":{}}}])",
                          R"([{"ifname":"can0","linkinfo":{"info_data":{"state":1,"bittiming":{"bitrate":"x"}}}}])"}) {
    ip_says(odd);
    EXPECT_THAT(check("can0"), ElementsAre(IsFinding(Verdict::ok, "bit rate not known"))) << odd;
  }
}

}  // namespace
}  // namespace azimuth
