#include "tests/tools/doctor/fake_machine.hpp"

namespace azimuth {
namespace {

using test::IsFinding;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class BoardChecks : public test::FakeMachine {
 protected:
  /// Writes the throttling bits as the driver of the Raspberry Pi firmware prints them.
  void firmware(const std::string& bits) {
    write("/sys/devices/platform/soc/soc:firmware/get_throttled", bits + "\n");
    const std::string device = "/sys/bus/platform/drivers/raspberrypi-firmware/soc:firmware";
    if (!test::fs::exists(machine.at(device))) link(device, "../../../../devices/platform/soc/soc:firmware");
  }
  void sensor(int number, const std::string& name, const std::string& alarm) {
    const std::string folder = "/sys/class/hwmon/hwmon" + std::to_string(number);
    write(folder + "/name", name + "\n");
    write(folder + "/in0_lcrit_alarm", alarm + "\n");
  }
  void cooling_device(int number, const std::string& type, int state) {
    const std::string folder = "/sys/class/thermal/cooling_device" + std::to_string(number);
    write(folder + "/type", type + "\n");
    write(folder + "/cur_state", std::to_string(state) + "\n");
  }
  struct Trip {
    std::string type;
    int millidegrees;
  };
  void zone(int number, const std::string& type, int millidegrees, const std::vector<Trip>& trips) {
    const std::string folder = "/sys/class/thermal/thermal_zone" + std::to_string(number);
    write(folder + "/type", type + "\n");
    write(folder + "/temp", std::to_string(millidegrees) + "\n");
    for (std::size_t i = 0; i < trips.size(); ++i) {
      const std::string trip = folder + "/trip_point_" + std::to_string(i);
      write(trip + "_type", trips[i].type + "\n");
      write(trip + "_temp", std::to_string(trips[i].millidegrees) + "\n");
    }
  }
};

TEST_F(BoardChecks, NothingIsSaidOfASupplyThatNothingLooksAt) {
  EXPECT_THAT(check_supply(machine), IsEmpty());
  sensor(0, "nvme", "1");
  EXPECT_THAT(check_supply(machine), IsEmpty()) << "of another kind";
}

TEST_F(BoardChecks, SupplyByTheFirmware) {
  firmware("0");
  EXPECT_THAT(check_supply(machine), ElementsAre(IsFinding(Verdict::ok, "holds")));
  firmware("50005");
  const Findings weak = check_supply(machine);
  EXPECT_THAT(weak, ElementsAre(IsFinding(Verdict::warning, "voltage is too low")));
  EXPECT_THAT(weak.front().fix, HasSubstr("grep -i voltage"));
  firmware("50000");
  EXPECT_THAT(check_supply(machine), ElementsAre(IsFinding(Verdict::warning, "has been too low since")));
  firmware("80008");
  EXPECT_THAT(check_supply(machine), ElementsAre(IsFinding(Verdict::ok, ""))) << "hot, which is another matter";
  firmware("nonsense");
  EXPECT_THAT(check_supply(machine), IsEmpty());
}

TEST_F(BoardChecks, SupplyByTheSensor) {
  sensor(0, "cpu_thermal", "1");
  sensor(1, "rpi_volt", "0");
  EXPECT_THAT(check_supply(machine), ElementsAre(IsFinding(Verdict::ok, "holds")));
  sensor(1, "rpi_volt", "1");
  EXPECT_THAT(check_supply(machine), ElementsAre(IsFinding(Verdict::warning, "voltage is too low")));
}

TEST_F(BoardChecks, HeatByTheFirmware) {
  EXPECT_THAT(check_heat(machine), IsFinding(Verdict::ok, "nothing slows the processor down"));
  for (const char* slowed : {"2", "4", "8", "e0008"}) {
    firmware(slowed);
    EXPECT_THAT(check_heat(machine), IsFinding(Verdict::warning, "slowed down because it is hot")) << slowed;
  }
  firmware("80000");
  EXPECT_THAT(check_heat(machine), IsFinding(Verdict::warning, "has been slowed down by heat"));
  firmware("50005");
  EXPECT_THAT(check_heat(machine), IsFinding(Verdict::ok, "")) << "by its voltage, not by heat";
}

TEST_F(BoardChecks, HeatByWhatTheKernelDoesAboutIt) {
  cooling_device(0, "pwm-fan", 3);
  cooling_device(1, "cpufreq-cpu0", 0);
  EXPECT_THAT(check_heat(machine), IsFinding(Verdict::ok, "")) << "a fan slows nothing down";
  for (const char* kind : {"cpufreq-cpu4", "thermal-cpufreq-1", "Processor"}) {
    cooling_device(1, kind, 2);
    const Finding slowed = check_heat(machine);
    EXPECT_THAT(slowed, IsFinding(Verdict::warning, "slowed down because it is hot")) << kind;
    EXPECT_THAT(slowed.fix, HasSubstr("/sys/class/thermal"));
  }
}

TEST_F(BoardChecks, HeatByTheWayToTheNearestLimit) {
  zone(0, "gpu-thermal", 60'000, {{"critical", 110'000}});
  zone(1, "cpu-thermal", 62'400, {{"active", 55'000}, {"passive", 0}, {"critical", 110'000}, {"passive", 85'000}});
  EXPECT_THAT(check_heat(machine), IsFinding(Verdict::ok, "cpu-thermal: 62 degrees of the 85"));
  zone(1, "cpu-thermal", 79'900, {});
  EXPECT_THAT(check_heat(machine), IsFinding(Verdict::ok, "cpu-thermal: 80 degrees"));
  zone(1, "cpu-thermal", 80'100, {});
  EXPECT_THAT(check_heat(machine), IsFinding(Verdict::warning, "cpu-thermal: 80 degrees of the 85"));
  zone(10, "skin-thermal", 90'000, {{"hot", 85'000}});
  EXPECT_THAT(check_heat(machine), IsFinding(Verdict::warning, "skin-thermal: 90 degrees of the 85"));
}

}  // namespace
}  // namespace azimuth
