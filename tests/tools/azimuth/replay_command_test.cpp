#include <cairo.h>
#include <cmath>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using Json = nlohmann::json;

class ReplayCommand : public testing::Test {
 protected:
  /// A small run that the test may modify.
  std::string small_run() {
    const std::string run = scratch_ / "run";
    EXPECT_EQ(azimuth({"simulate", run, "--world", "coloured-lab"}).code, 0);
    return run;
  }

  void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
    const Outcome outcome = azimuth(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    for (const std::string& word : words) EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }

  ScratchFolder scratch_;
};

TEST_F(ReplayCommand, WritesReportPictureAndTrajectory) {
  const std::string report = scratch_ / "report.json", plot = scratch_ / "map.png", tum = scratch_ / "lab.tum";
  const Outcome outcome = azimuth(
      {"replay", test::shipped_run().string(), "--report", report, "--plot", plot, "--tum", tum, "--seed", "9"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("position"), std::string::npos);
  EXPECT_EQ(outcome.err, "");

  const Json json = Json::parse(file_bytes(report));
  EXPECT_EQ(json["run"], "lab");
  EXPECT_EQ(json["estimator"], "smoother");
  EXPECT_LT(json["hindsight"]["rmse_m"], json["pose"]["rmse_m"]);
  EXPECT_EQ(json["seed"], 9);
  EXPECT_EQ(json["map"]["landmarks"], json["map"]["settled"]);
  EXPECT_EQ(json["map"]["true_landmarks"], 24);
  EXPECT_EQ(json["map"]["matched"], 24);
  EXPECT_LT(json["pose"]["rmse_m"], 0.2);
  EXPECT_LT(json["pose"]["rmse_m"], 0.3 * json["odometry_only"]["rmse_m"].get<double>());
  EXPECT_NE(outcome.out.find(json["digest"].get<std::string>()), std::string::npos);
  EXPECT_EQ(file_bytes(plot).substr(1, 3), "PNG");
  std::istringstream lines(file_bytes(tum));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) ++count;
  EXPECT_EQ(count, json["steps"]);
}

/// The share of pixels in which two PNG files differ; 1 if their sizes differ or a file cannot be read.
double unlike(const std::string& one, const std::string& other) {
  const auto read = [](const std::string& file) {
    return std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>(
        cairo_image_surface_create_from_png(file.c_str()), &cairo_surface_destroy);
  };
  const auto a = read(one), b = read(other);
  const int width = cairo_image_surface_get_width(a.get()), height = cairo_image_surface_get_height(a.get());
  const int stride = cairo_image_surface_get_stride(a.get());
  if (width == 0 || width != cairo_image_surface_get_width(b.get()) ||
      height != cairo_image_surface_get_height(b.get()) || stride != cairo_image_surface_get_stride(b.get()))
    return 1.0;
  constexpr int kFar = 64;
  const unsigned char *in_a = cairo_image_surface_get_data(a.get()), *in_b = cairo_image_surface_get_data(b.get());
  int found = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int green = y * stride + 4 * x + 1;
      found += std::abs(int(in_a[green]) - int(in_b[green])) > kFar ? 1 : 0;
    }
  return double(found) / (double(width) * double(height));
}

/// Fonts and the last digits of an estimate may differ from machine to machine. Another estimator must draw a picture
/// that differs more.
TEST_F(ReplayCommand, DrawsTheMapThatTheReadmeShows) {
  const std::string shown = test::source_folder() / "docs/map.png", plot = scratch_ / "map.png",
                    other = scratch_ / "other.png";
  const std::string readme = file_bytes(test::source_folder() / "README.md"),
                    command = "azimuth replay runs/lab --report report.json --plot map.png";
  const auto at = readme.find(command), picture = readme.find("(docs/map.png)");
  ASSERT_NE(at, std::string::npos);
  ASSERT_LT(at, picture);
  EXPECT_LT(picture - at, 300u) << "the picture stands below its command";
  ASSERT_EQ(azimuth({"replay", test::shipped_run().string(), "--quiet", "--plot", plot}).code, 0);
  EXPECT_LT(unlike(plot, shown), 0.005) << "scripts/results draws it anew";
  ASSERT_EQ(
      azimuth({"replay", test::shipped_run().string(), "--quiet", "--plot", other, "--set", "estimator=ekf"}).code, 0);
  EXPECT_GT(unlike(other, shown), 0.005);
}

TEST_F(ReplayCommand, ReportSaysWhatOfALogCouldNotBeRead) {
  const std::string log = scratch_ / "drive.lcm", report = scratch_ / "report.json";
  ASSERT_EQ(azimuth({"simulate", log, "--seconds", "20"}).code, 0);
  const auto incomplete = [&] {
    EXPECT_EQ(azimuth({"replay", log, "--report", report, "--quiet"}).code, 0);
    return Json::parse(file_bytes(report))["incomplete"];
  };
  EXPECT_TRUE(incomplete().is_null());
  const std::string whole = file_bytes(log);
  write_file(log, whole.substr(0, whole.size() - 10));
  EXPECT_THAT(incomplete().get<std::string>(), testing::EndsWith(" damaged bytes"));
}

TEST_F(ReplayCommand, WritesAPageOfOneRunAndOfSeveral) {
  const std::string page = scratch_ / "page.html", run = small_run();
  const auto data = [&] {
    const std::string text = file_bytes(page), begin = "id=\"data\">";
    const std::size_t from = text.find(begin) + begin.size();
    return Json::parse(text.substr(from, text.find("</script>", from) - from));
  };
  ASSERT_EQ(azimuth({"replay", test::one_lap(), "--html", page, "--quiet"}).code, 0);
  EXPECT_EQ(data()["runs"].size(), 1u);
  const Json one = data()["runs"][0];
  EXPECT_EQ(one["digest"], digest_of(test::one_lap()));
  EXPECT_EQ(one["series"]["t"].size(), one["steps"]);
  EXPECT_GT(one["map"]["hindsight"].size(), 10u);
  EXPECT_EQ(azimuth({"replay", run, test::one_lap(), scratch_ / "nowhere", "--html", page, "--quiet"}).code, 2);
  ASSERT_EQ(data()["runs"].size(), 2u);
  EXPECT_EQ(data()["runs"][1]["digest"], one["digest"]);
  EXPECT_EQ(azimuth({"replay", run, "--html", scratch_ / "nowhere/page.html"}).code, 1);
}

TEST_F(ReplayCommand, QuietPrintsNothing) {
  const Outcome outcome = azimuth({"replay", test::one_lap(), "--quiet"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(ReplayCommand, HintsAtACheckWhereBearingsWithNamesAreRefused) {
  // GIVEN a run with health "tracking" most of the time, and a rig that has the direction of the azimuths wrong
  const std::string flipped = scratch_ / "flipped.toml";
  std::string rig = file_bytes(test::shipped_run() / "rig.toml");
  const std::string key = "identities = true\n";
  ASSERT_NE(rig.find(key), std::string::npos);
  rig.insert(rig.find(key), "azimuths_clockwise = true\n");
  write_file(flipped, rig);
  // THEN the summary gives a hint, and it gives none with the right rig
  const Outcome wrong =
      azimuth({"replay", test::shipped_run().string(), "--rig", flipped, "--set", "smoother.doubt_rig=false"});
  EXPECT_NE(
      wrong.out.find("% of the bearings were refused although they name their landmarks\nnext        `azimuth check " +
                     test::shipped_run().string() + "`"),
      std::string::npos)
      << wrong.out;
  // AND with smoother.doubt_rig the smoother rejects the rig and reports little tracking
  const Outcome doubted = azimuth({"replay", test::shipped_run().string(), "--rig", flipped});
  EXPECT_NE(doubted.out.find("verdict     less than half of it was tracked\nnext        `azimuth check "),
            std::string::npos)
      << doubted.out;
  const Outcome right = azimuth({"replay", test::shipped_run().string()});
  EXPECT_NE(right.out.find("\nnext        `azimuth map refine "), std::string::npos) << right.out;
}

TEST_F(ReplayCommand, GivesTheSameDigestEveryTime) {
  const std::string digest = digest_of(test::one_lap());
  EXPECT_EQ(digest.size(), 16u) << digest;
  EXPECT_EQ(digest_of(test::one_lap()), digest);
}

TEST_F(ReplayCommand, SettingsReachTheEstimator) {
  const std::string run = small_run(), configuration = scratch_ / "azimuth.toml";
  const std::string recommended = digest_of(run, {"--set", "estimator=ekf"});
  EXPECT_NE(digest_of(run), recommended);
  const std::string gated = digest_of(run, {"--set", "estimator=ekf", "--set", "ekf.thinning_s=1.5"});
  EXPECT_NE(gated, recommended);
  write_file(configuration, "estimator = \"ekf\"\n[ekf]\nthinning_s = 1.5\n");
  EXPECT_EQ(digest_of(run, {"--config", configuration}), gated);
  EXPECT_EQ(digest_of(run, {"--config", configuration, "--set", "ekf.thinning_s=0.5"}), recommended);
}

TEST_F(ReplayCommand, NamesTheLineOfBadData) {
  const std::string run = small_run();
  write_file(run + "/odometry.csv", "t_s,x_m,y_m,heading_rad\n0,0,0,0\n1,zero,0,0\n");
  expect_refused({"replay", run}, {"odometry.csv:3:"});
}

TEST_F(ReplayCommand, NamesTheLineOfABadRig) {
  const std::string run = small_run();
  write_file(run + "/rig.toml", "front_end = \"bearings\"\n[camera]\nsigma_bearing_deg = 1.5\n");
  expect_refused({"replay", run}, {"rig.toml:3:", "sigma_bearing_rad"});
}

TEST_F(ReplayCommand, NamesTheLineOfABadConfiguration) {
  const std::string configuration = scratch_ / "azimuth.toml";
  write_file(configuration, "[ekf]\nthining_s = 9.0\nmax_landmarks = -4\n");
  expect_refused({"replay", test::one_lap(), "--config", configuration},
                 {"azimuth.toml:2:", "thinning_s", "azimuth.toml:3:"});
}

TEST_F(ReplayCommand, RefusesABadOverride) {
  expect_refused({"replay", test::one_lap(), "--set", "ekf.no_such_key=1"}, {"no_such_key"});
  expect_refused({"replay", test::one_lap(), "--set", "daemon.lcm.url=memq://"}, {"daemon.lcm.url", "only azimuthd"});
}

TEST_F(ReplayCommand, RefusesWhatIsNotThere) {
  expect_refused({"replay", scratch_ / "nowhere"}, {"nowhere"});
  expect_refused({"replay", test::one_lap(), "--config", scratch_ / "nowhere.toml"}, {"nowhere.toml"});
}

TEST_F(ReplayCommand, RefusesAFrontEndWithoutFrames) {
  const std::string run = small_run();
  expect_refused({"replay", run, "--front-end", "colour"}, {"no frames", "colour"});
  expect_refused({"replay", run, "--set", "front_end=sift"}, {"no frames", "sift"});
  expect_refused({"replay", run, "--set", "front_end=sonar"}, {"front_end=sonar"});
  expect_refused({"replay", run, "--front-end", "sonar"}, {"sonar"});
}

TEST_F(ReplayCommand, RefusesImagesForARigWithoutACamera) {
  const std::string run = small_run();
  write_file(run + "/frames.csv", "t_s,file\n1,frames/000000.jpg\n");
  expect_refused({"replay", run, "--front-end", "colour"}, {"rig.toml", "bearings"});
}

TEST_F(ReplayCommand, RecordedBearingsOfAnImageFrontEndNeedNoImages) {
  const std::string run = small_run(), as_ready_made = azimuth({"replay", run}).out;
  std::string rig = file_bytes(run + "/rig.toml");
  rig.replace(rig.find("\"bearings\""), 10, "\"colour\"");
  write_file(run + "/rig.toml", rig);
  const Outcome outcome = azimuth({"replay", run});
  EXPECT_EQ(outcome.code, 0);
  const auto first_line = [](const std::string& text) {
    const std::string line = text.substr(0, text.find('\n'));
    return line.substr(line.find(", "));
  };
  EXPECT_EQ(first_line(outcome.out), first_line(as_ready_made)) << "the same samples, believed otherwise";
}

TEST_F(ReplayCommand, RefusesFramesThatNobodyIsToLookAt) {
  const std::string run = small_run();
  write_file(run + "/frames.csv", "t_s,file\n1,frames/000000.jpg\n");
  std::filesystem::remove(run + "/bearings.csv");
  expect_refused({"replay", run}, {"no bearings"});
}

TEST_F(ReplayCommand, RefusesARunWithoutBearings) {
  const std::string run = small_run();
  write_file(run + "/bearings.csv", "t_s,azimuth_rad,landmark_id\n");
  expect_refused({"replay", run}, {"bearings"});
}

TEST_F(ReplayCommand, RefusesAnUnknownOption) { expect_refused({"replay", test::one_lap(), "--fast"}, {"--fast"}); }

TEST_F(ReplayCommand, FailsWhereItCannotWriteBeforeItRuns) {
  const std::string run = small_run(), nowhere = scratch_ / "no-folder/out.png";
  for (const char* option : {"--report", "--plot", "--tum"}) {
    for (const std::string& from : {run, scratch_ / "not even a run"}) {
      const Outcome outcome = azimuth({"replay", from, option, nowhere});
      EXPECT_EQ(outcome.code, 1) << option;
      EXPECT_NE(outcome.err.find(nowhere + ": cannot be written"), std::string::npos) << outcome.err;
      EXPECT_EQ(outcome.out, "");
    }
    EXPECT_EQ(azimuth({"replay", run, option, run}).code, std::string(option) == "--plot" ? 2 : 1) << "a folder";
  }
}

TEST_F(ReplayCommand, LeavesNothingOfAFileThatItOnlyTried) {
  const std::string plot = scratch_ / "map.png", kept = scratch_ / "kept.png";
  write_file(kept, "as it was");
  EXPECT_EQ(azimuth({"replay", scratch_ / "nowhere", "--plot", plot}).code, 2);
  EXPECT_FALSE(std::filesystem::exists(plot));
  EXPECT_EQ(azimuth({"replay", scratch_ / "nowhere", "--plot", kept}).code, 2);
  EXPECT_EQ(file_bytes(kept), "as it was");
}

TEST_F(ReplayCommand, DrawsStrokesWhereTheNameAsksForThem) {
  const std::string svg = scratch_ / "map.svg", pdf = scratch_ / "map.pdf";
  EXPECT_EQ(azimuth({"replay", test::one_lap(), "--quiet", "--plot", svg}).code, 0);
  EXPECT_NE(file_bytes(svg).find("<svg"), std::string::npos);
  EXPECT_EQ(file_bytes(svg).find("<image"), std::string::npos);
  EXPECT_EQ(azimuth({"replay", test::one_lap(), "--quiet", "--plot", pdf}).code, 0);
  EXPECT_EQ(file_bytes(pdf).substr(0, 5), "%PDF-");
  expect_refused({"replay", scratch_ / "not even a run", "--plot", scratch_ / "map.jpg"}, {"map.jpg", ".svg or .pdf"});
}

}  // namespace
}  // namespace azimuth::test
