#include "tests/tools/doctor/fake_machine.hpp"

namespace azimuth {
namespace {

using test::IsFinding;
using testing::HasSubstr;

class CoreChecks : public test::FakeMachine {
 protected:
  void online(const std::string& list) { write("/sys/devices/system/cpu/online", list + "\n"); }
  void capacity(int cpu, int value) {
    write("/sys/devices/system/cpu/cpu" + std::to_string(cpu) + "/cpu_capacity", std::to_string(value) + "\n");
  }
  /// Four slow cores and two fast ones, as some boards have.
  void slow_and_fast() {
    online("0-5");
    for (int cpu = 0; cpu < 6; ++cpu) capacity(cpu, cpu < 4 ? 381 : 1024);
  }
  void free_kb(const std::string& number) {
    write("/proc/meminfo", "MemTotal:        3884392 kB\nMemFree:  9 kB\nMemAvailable:    " + number + " kB\n");
  }
};

TEST_F(CoreChecks, Cores) {
  EXPECT_THAT(check_cores(machine, {}), IsFinding(Verdict::unknown, "does not say"));
  online("0-3");
  EXPECT_THAT(check_cores(machine, {}), IsFinding(Verdict::ok, "4 cores"));
  online("0,2-3,7");
  EXPECT_THAT(check_cores(machine, {}), IsFinding(Verdict::ok, "4 cores"));
  online("0");
  const Finding alone = check_cores(machine, {});
  EXPECT_THAT(alone, IsFinding(Verdict::warning, "1 core: images and estimates wait for each other"));
  EXPECT_EQ(alone.fix, "lscpu --extended");
  online("none, really");
  EXPECT_THAT(check_cores(machine, {}), IsFinding(Verdict::unknown, ""));
}

TEST_F(CoreChecks, TheBoardIsNamed) {
  online("0-3");
  write("/proc/device-tree/model", std::string("Raspberry Pi 4 Model B Rev 1.4\0", 31));
  EXPECT_EQ(check_cores(machine, {}).what, "Raspberry Pi 4 Model B Rev 1.4: 4 cores");
}

TEST_F(CoreChecks, FastCoresAreNamed) {
  slow_and_fast();
  EXPECT_THAT(check_cores(machine, {}), IsFinding(Verdict::ok, "6 cores, the fast ones are 4, 5"));
}

TEST_F(CoreChecks, ThreadsBelongOnFastCoresThatAreThere) {
  slow_and_fast();
  EXPECT_THAT(check_cores(machine, {{"estimator_cpu", 4}, {"perception_cpu", 5}}), IsFinding(Verdict::ok, ""));
  const Finding slow = check_cores(machine, {{"estimator_cpu", 4}, {"perception_cpu", 0}});
  EXPECT_THAT(slow, IsFinding(Verdict::warning, "the fast ones are 4, 5; daemon.realtime.perception_cpu is 0, a slow"));
  EXPECT_THAT(slow.what, Not(HasSubstr("estimator_cpu")));
  EXPECT_EQ(slow.fix, "lscpu --extended");
  online("0-4");
  EXPECT_THAT(check_cores(machine, {{"estimator_cpu", 5}}),
              IsFinding(Verdict::warning, "daemon.realtime.estimator_cpu is 5, and there is no such core"));
}

TEST_F(CoreChecks, Memory) {
  EXPECT_THAT(check_memory(machine), IsFinding(Verdict::unknown, "does not say"));
  free_kb("976562");
  EXPECT_THAT(check_memory(machine), IsFinding(Verdict::ok, "1000 MB of memory are free"));
  free_kb("97656");
  const Finding full = check_memory(machine);
  EXPECT_THAT(full, IsFinding(Verdict::warning, "100 MB of memory are free"));
  EXPECT_THAT(full.fix, HasSubstr("--sort=-rss"));
}

}  // namespace
}  // namespace azimuth
