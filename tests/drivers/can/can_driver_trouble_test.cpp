// Behaviour of the driver when interface, adapter, bus or base fail.

#include <cerrno>
#include <deque>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can/error.h>

#include "drivers/can/can_driver.hpp"
#include "tests/drivers/can/can_driver_bench.hpp"
#include "tests/drivers/can/fake_base.hpp"
#include "tests/support/allocation_counter.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;
using test::DriverBench;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(CanDriver, AnInterfaceThatIsNotThereIsLookedForAndToldOnce) {
  DriverBench bench;
  bench.bus.is_there = false;
  bench.run(5s);
  EXPECT_EQ(bench.driver.state().connection, Connection::away);
  EXPECT_EQ(bench.driver.descriptor(), -1);
  EXPECT_THAT(bench.events, ElementsAre("can0: no such interface"));
  bench.bus.is_there = true;
  bench.run(250ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  EXPECT_EQ(bench.driver.descriptor(), 99);
}

TEST(CanDriver, AnAdapterThatIsPluggedInAgainGoesOnFromItsCounters) {
  DriverBench bench;
  bench.run(1s);
  for (int i = 1; i <= 20; ++i) {
    bench.bus.is_there = false;
    bench.run(1s);
    EXPECT_EQ(bench.driver.state().connection, Connection::away);
    ++bench.bus.generation;
    bench.bus.is_there = true;
    bench.run(300ms);
    EXPECT_EQ(bench.driver.state().connection, Connection::running) << i;
    EXPECT_EQ(bench.driver.state().reconnects(), static_cast<std::uint64_t>(i));
  }
  EXPECT_EQ(bench.driver.state().restarts, 0U);
  EXPECT_NEAR(bench.readings.back().T_odom_body.x_m, bench.base.pose().x_m, 0.012);
}

TEST(CanDriver, AnInterfaceThatIsReplacedUnseenIsNoticed) {
  DriverBench bench;
  bench.run(1s, false);
  EXPECT_EQ(bench.driver.state().connection, Connection::starting);
  EXPECT_EQ(bench.bus.opened, 1);
  ++bench.bus.generation;
  bench.run(500ms);
  EXPECT_EQ(bench.bus.opened, 2);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
}

TEST(CanDriver, AnInterfaceThatIsSwitchedOffIsKept) {
  DriverBench bench;
  bench.run(1s);
  bench.bus.is_up = false;
  bench.run(100ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::away);
  EXPECT_EQ(bench.driver.state().trouble, "can0: is down");
  bench.run(2s);
  bench.bus.is_up = true;
  bench.run(30ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  EXPECT_EQ(bench.bus.opened, 1);
  EXPECT_EQ(bench.driver.state().reconnects(), 1U);
}

TEST(CanDriver, ASilentBaseIsStaleAndNotAReconnect) {
  DriverBench bench;
  bench.run(1s);
  bench.run(1s, false);
  EXPECT_EQ(bench.driver.state().connection, Connection::silent);
  EXPECT_EQ(bench.driver.state().stale, 1U);
  EXPECT_THAT(bench.events, Contains("can0: no odometry"));
  bench.run(100ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  EXPECT_EQ(bench.driver.state().reconnects(), 0U);
}

TEST(CanDriver, BusOffIsToldAndEndsWhenFramesComeAgain) {
  DriverBench bench;
  bench.run(1s);
  bench.error(CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE);
  bench.run(10ms);
  EXPECT_EQ(bench.driver.state().bus, CanBusState::passive);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  bench.error(CAN_ERR_BUSOFF);
  bench.run(100ms, false);
  EXPECT_EQ(bench.driver.state().bus, CanBusState::off);
  EXPECT_EQ(bench.driver.state().connection, Connection::away);
  EXPECT_THAT(bench.driver.state().trouble, HasSubstr("restart-ms"));
  bench.error(CAN_ERR_RESTARTED);
  bench.run(2s);
  EXPECT_EQ(bench.driver.state().bus, CanBusState::active);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  EXPECT_EQ(bench.driver.state().bus_offs, 1U);
  EXPECT_EQ(bench.driver.state().error_frames, 3U);
  EXPECT_EQ(bench.driver.state().reconnects(), 1U);
  EXPECT_THAT(bench.events, Contains("can0: error-passive"));
}

TEST(CanDriver, BusOffIsToldAlsoWhenFramesComeAgainInTheSameTurn) {
  DriverBench bench;
  bench.run(1s);
  bench.events.clear();
  bench.error(CAN_ERR_BUSOFF);
  bench.run(10ms);
  EXPECT_EQ(bench.driver.state().connection, Connection::running);
  EXPECT_THAT(bench.events, ElementsAre(HasSubstr("can0: bus-off"), "odometry comes from can0"));
}

TEST(CanDriver, ManyErrorFramesFillNoLog) {
  DriverBench bench;
  bench.run(1s);
  bench.events.clear();
  for (int i = 0; i < 1000; ++i) {
    bench.error(CAN_ERR_CRTL, i % 2 == 0 ? CAN_ERR_CRTL_RX_PASSIVE : CAN_ERR_CRTL_ACTIVE);
    bench.run(10ms);
  }
  EXPECT_LE(bench.events.size(), 12U);
  EXPECT_GE(bench.events.size(), 1U);
  EXPECT_EQ(bench.driver.state().error_frames, 1000U);
}

}  // namespace
}  // namespace azimuth
