#include "tools/replay_page/page_run.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "tools/replay/replay_record.hpp"
#include "tools/simulated/simulated_run.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::ordered_json;

struct Watched {
  Run run;
  StepLog log;
  ReplayResult result;
  Report report;

  Json page(std::size_t runs = 1) const {
    return page_run(
        {.run = run, .result = result, .report = report, .steps = log.steps(), .pictures = {}, .classes = {}}, runs);
  }
};

/// A replay of the scenario by the EKF, with the data of the page.
Watched watched(const Scenario& scenario) {
  Watched outcome;
  outcome.run = simulated_run(scenario);
  const Rig rig = read_rig(outcome.run.rig_toml, "rig.toml").value();
  StepLog& log = outcome.log;
  const ReplayWatch watch{
      .before_update = [&log](const BearingSet& set, const Estimator& before) { log.before_update(set, before); },
      .after_step = [&log](const Estimate& estimate) { log.after_step(estimate); }};
  outcome.result = replay(outcome.run, rig, make_ekf_estimator(rig, EkfSettings{}), StageSettings{}, {},
                          Ending::as_in_the_daemon, watch);
  outcome.report = evaluate(replay_record(outcome.run, rig, "ekf", 5, outcome.result));
  return outcome;
}

const Watched& one_lap() {
  static const Watched kLap = watched(lab(1, 1));
  return kLap;
}

TEST(PageRun, ARecordingThatWasCutOffSaysSo) {
  Watched lap = one_lap();
  EXPECT_EQ(lap.page()["unread"], "");
  lap.run.skipped.foreign_events = 7;  // events of unrelated programs
  EXPECT_EQ(lap.page()["unread"], "");
  lap.run.skipped.damaged_bytes = 17;
  EXPECT_EQ(lap.page()["unread"], "the recording was cut off, or is damaged: 17 damaged bytes");
  lap.run.skipped = {};
  lap.run.skipped.unrecorded_events = 3;
  EXPECT_EQ(lap.page()["unread"], "not all of the recording is shown: 3 events not recorded");
}

double last_number(const Json& values) {
  for (auto value = values.rbegin(); value != values.rend(); ++value)
    if (!value->is_null()) return value->get<double>();
  return kNotMeasured;
}

double most(const Json& values) {
  double greatest = 0.0;
  for (const Json& value : values)
    if (!value.is_null()) greatest = std::max(greatest, std::abs(value.get<double>()));
  return greatest;
}

TEST(PageRun, LookingOnChangesNothing) {
  const Rig rig = read_rig(one_lap().run.rig_toml, "rig.toml").value();
  const ReplayResult alone = replay(one_lap().run, rig, make_ekf_estimator(rig, EkfSettings{}), StageSettings{});
  EXPECT_EQ(alone.digest, one_lap().result.digest);
  EXPECT_EQ(one_lap().log.steps().size(), alone.estimates.size());
}

TEST(PageRun, AgreesWithTheReport) {
  const Json series = one_lap().page()["series"];
  const Report& report = one_lap().report;
  EXPECT_EQ(series["t"].size(), report.steps);
  EXPECT_NEAR(last_number(series["anees"]), report.consistency.anees, 1e-4 * report.consistency.anees);
  EXPECT_NEAR(most(series["off"]), report.position_m.max, 1e-4 * report.position_m.max);
  EXPECT_EQ(series["accepted"].back(), report.association.accepted);
  EXPECT_EQ(series["rejected"].back(), report.association.rejected);
  for (const auto& [name, values] : series.items()) EXPECT_EQ(values.size(), report.steps) << name;
}

// The gate lets 99.7 % of the filter's innovations pass at most, so their mean NIS is near 1. It must never be NaN.
TEST(PageRun, InnovationsAreAsLargeAsTheFilterSays) {
  double sum = 0.0;
  std::size_t compared = 0;
  for (const PageStep& step : one_lap().log.steps()) {
    sum += step.nis;
    compared += step.compared;
  }
  ASSERT_GT(compared, one_lap().report.association.accepted / 2);
  const double mean = sum / static_cast<double>(compared);
  EXPECT_GT(mean, 0.5);
  EXPECT_LT(mean, 1.5);
}

TEST(PageRun, ManyRunsShareTheInstants) {
  const std::size_t runs = kMostPageInstants / 100;
  const Json whole = one_lap().page()["series"], thin = one_lap().page(runs)["series"];
  ASSERT_GT(whole["t"].size(), 100u);
  EXPECT_LE(thin["t"].size(), 100u);
  EXPECT_EQ(thin["step"].front(), 0);
  EXPECT_EQ(thin["step"].back(), whole["step"].back());
  for (const char* column : {"error_x", "error_y", "error_heading", "nees", "nis", "off", "x", "y"})
    EXPECT_EQ(most(thin[column]), most(whole[column])) << column;
}

TEST(PageRun, WithoutTruthThereIsNoError) {
  Watched blind = one_lap();
  blind.run.truth.clear();
  const Rig rig = read_rig(blind.run.rig_toml, "rig.toml").value();
  blind.report = evaluate(replay_record(blind.run, rig, "ekf", 5, blind.result));
  const Json page = blind.page();
  EXPECT_FALSE(page["series"].contains("error_x"));
  EXPECT_FALSE(page["series"].contains("truth_x"));
  EXPECT_EQ(page["series"]["two_sigma_x"].size(), blind.report.steps);
  EXPECT_GT(most(page["series"]["two_sigma_heading"]), 0.0);
  for (const Json& metric : page["metrics"]) EXPECT_NE(metric["key"], "rmse");
}

TEST(PageRun, ANameCannotLeaveTheData) {
  Watched named = one_lap();
  named.report.run = "</script><script>\"'\xff\xe2\x80\xa8";
  const std::string page = replay_page({named.page()}, "azimuth");
  EXPECT_EQ(page.find("</script><script>"), std::string::npos);
  const std::string begin = "id=\"data\">";
  const std::size_t from = page.find(begin) + begin.size();
  const std::string data = page.substr(from, page.find("</script>", from) - from);
  EXPECT_EQ(Json::parse(data)["runs"][0]["name"], "</script><script>\"'\xef\xbf\xbd\xe2\x80\xa8");
}

TEST(PageSize, AnHourStaysSmall) {
  Watched hour = watched(lab(1, 1));
  const std::size_t steps = 36000;
  const std::vector<EstimateRecord> lap = hour.result.estimates;
  const std::vector<StepHealth> lap_health = hour.result.healths;
  const std::vector<PageStep> lap_steps = hour.log.steps();
  std::vector<PageStep> all;
  hour.result.estimates.clear(), hour.result.healths.clear(), hour.result.times.step_us.clear();
  for (std::size_t i = 0; i < steps; ++i) {
    const Stamp stamp = stamp_from_us(static_cast<std::int64_t>(100'000 * i));
    hour.result.estimates.push_back(lap[i % lap.size()]);
    hour.result.estimates.back().stamp = stamp;
    hour.result.healths.push_back(lap_health[i % lap.size()]);
    hour.result.healths.back().stamp = stamp;
    hour.result.times.step_us.push_back(static_cast<double>(i * 7919 % 1009));
    all.push_back(lap_steps[i % lap.size()]);
  }
  hour.report.steps = steps;
  const Json run = page_run({hour.run, hour.result, hour.report, all, {}, {}}, 1);
  EXPECT_LE(run["series"]["t"].size(), kMostPageInstants);
  EXPECT_NEAR(run["series"]["t"].back().get<double>(), 3599.9, 1e-6);
  EXPECT_LT(replay_page({run}, "azimuth").size(), 6'000'000u);
}

std::vector<StepHealth> flickering(std::size_t steps, std::size_t lost_at) {
  std::vector<StepHealth> healths;
  for (std::size_t i = 0; i < steps; ++i)
    healths.push_back({stamp_from_us(static_cast<std::int64_t>(100'000 * i)),
                       i == lost_at ? Health::lost
                       : i % 2 == 0 ? Health::tracking
                                    : Health::degraded,
                       i % 2 == 0 ? "" : "few bearings", true});
  return healths;
}

TEST(HealthStretches, JoinWhatIsAlike) {
  std::vector<StepHealth> healths = flickering(5, 9);
  healths[1].health = Health::tracking, healths[1].reason = "";
  const std::vector<HealthStretch> stretches = health_stretches(healths, 10);
  ASSERT_EQ(stretches.size(), 3u);
  EXPECT_DOUBLE_EQ(stretches[0].to_s, 0.3);
  EXPECT_EQ(stretches[1].health, Health::degraded);
  EXPECT_EQ(stretches[1].reason, "few bearings");
  EXPECT_TRUE(health_stretches({}, 10).empty());
}

TEST(HealthStretches, OfTooManyTheWorstAreKept) {
  for (const std::size_t lost_at : {0u, 1u, 1234u, 4999u}) {
    const std::vector<HealthStretch> stretches = health_stretches(flickering(5000, lost_at), 100);
    EXPECT_LE(stretches.size(), 100u);
    EXPECT_GT(stretches.size(), 50u);
    EXPECT_EQ(std::ranges::count(stretches, Health::lost, &HealthStretch::health), 1) << lost_at;
    for (std::size_t i = 1; i < stretches.size(); ++i) EXPECT_EQ(stretches[i].from_s, stretches[i - 1].to_s);
  }
}

}  // namespace
}  // namespace azimuth
