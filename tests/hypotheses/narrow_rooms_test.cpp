// A camera with a forward field of view, in rooms with identical landmarks.

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "tests/support/nameless_run.hpp"
#include "tests/support/narrow_room.hpp"

namespace azimuth {
namespace {

constexpr int kRooms = 20;

TEST(NarrowRooms, DrawnMapsKnowBetterThanABeamWhereTheRobotIs) {
  double drawn_m = 0.0, beam_m = 0.0, odometry_m = 0.0, anees = 0.0, past_m = 0.0, past_anees = 0.0;
  int better = 0, worse_than_odometry = 0;
  for (std::uint64_t seed = 101; seed <= 100 + kRooms; ++seed) {
    SCOPED_TRACE(seed);
    const azimuth::Run run = narrow_room(seed);
    const Rig rig = *read_rig(run.rig_toml, run.rig_file);
    InTurn workers;
    NamelessMapScore map;
    NamelessSettings settings = nameless_settings_for(rig);
    const NamelessRun drawn = nameless_run(run, rig, settings, workers, map);
    settings.drawn.populations = 0;
    const NamelessRun beam = nameless_run(run, rig, settings, workers, map);
    const double of_drawn = run_error(run, drawn.online).rmse_m, of_beam = run_error(run, beam.online).rmse_m,
                 of_odometry = run_error(run, drawn.odometry).rmse_m;
    drawn_m += of_drawn / kRooms;
    beam_m += of_beam / kRooms;
    odometry_m += of_odometry / kRooms;
    anees += run_error(run, drawn.online).anees / kRooms;
    past_m += run_error(run, drawn.smoothed).rmse_m / kRooms;
    past_anees += run_error(run, drawn.smoothed).anees / kRooms;
    better += of_drawn < of_beam ? 1 : 0;
    worse_than_odometry += of_drawn > of_odometry ? 1 : 0;
    EXPECT_TRUE(std::ranges::none_of(drawn.trust, &Trust::trusted)) << "it cannot know";
  }
  fmt::print(
      "odometry {:.3f} m  beam {:.3f} m  drawn maps {:.3f} m (ANEES {:.1f}), better than the beam in {}, worse "
      "than odometry in {} of {}; the past {:.3f} m (ANEES {:.1f})\n",
      odometry_m, beam_m, drawn_m, anees, better, worse_than_odometry, kRooms, past_m, past_anees);
  EXPECT_LE(drawn_m, 0.9 * beam_m);
  EXPECT_LE(drawn_m, 0.75 * odometry_m);
  EXPECT_LE(anees, 4.0);
  EXPECT_LE(past_m, 0.75 * odometry_m);
  EXPECT_LE(past_anees, 4.0);
  EXPECT_LE(worse_than_odometry, 4);
}

}  // namespace
}  // namespace azimuth
