// Matches features of rendered rooms between images 0.2 to 2 m apart, with Azimuth's SIFT and OpenCV's SIFT, ORB and
// AKAZE. Reports the share of the findable features that are matched correctly at a precision of 99 %.
//
// usage: feature_matches [OPTION...]      see --help

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fmt/format.h>
#include <vector>

#include "tests/support/feature_matching.hpp"

namespace azimuth {
namespace {

struct Options {
  std::vector<std::uint64_t> seeds{1, 5};
  std::vector<int> most{90, 300};
  test::RoomPairSettings pairs;
};

std::vector<test::FeatureMethod> methods(const CameraRig& rig, int most) {
  SiftSettings settings;
  settings.target_count = most;
  std::vector<test::FeatureMethod> methods{test::azimuth_features(rig, settings, "Azimuth")};
  settings = paper_sift_preset();
  settings.contrast = SiftSettings{}.contrast;
  settings.target_count = most;
  methods.push_back(test::azimuth_features(rig, settings, "Azimuth, as printed"));
  for (const char* const which : {"SIFT", "ORB", "AKAZE"}) methods.push_back(test::opencv_features(rig, which, most));
  methods.push_back(test::opencv_features(rig, "SIFT", most, true));
  return methods;
}

void compare(const Options& options) {
  std::vector<test::RoomPairs> rooms;
  for (std::uint64_t seed = options.seeds[0]; seed <= options.seeds[1]; ++seed)
    rooms.push_back(test::room_pairs(seed, options.pairs));
  for (const int most : options.most) {
    fmt::print("{} features at most\n{:<26} {:>8} {:>8} {:>6} {:>6} {:>6}\n", most, "", "features", "findable", "right",
               "recall", "ratio");
    for (const test::FeatureMethod& method : methods(rooms.front().rig, most)) {
      const test::MatchScore score = match_score(rooms, method);
      fmt::print("{:<26} {:8} {:8} {:6} {:6.3f} {:6.3f}\n", method.name, score.features, score.findable, score.right,
                 score.recall(), score.ratio);
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace azimuth

int main(int argc, char** argv) {
  azimuth::Options options;
  CLI::App app{"Features matched between images of rendered rooms, ours beside OpenCV's"};
  app.add_option("--seeds", options.seeds, "first and last room")->expected(2);
  app.add_option("--features", options.most, "in an image, at most; a table for each");
  app.add_option("--pairs", options.pairs.count, "of images in a room");
  app.add_option("--least", options.pairs.least_m, "metres apart");
  app.add_option("--most", options.pairs.most_m, "metres apart");
  app.add_option("--light", options.pairs.light, "of second images, times the first's");
  CLI11_PARSE(app, argc, argv);
  azimuth::compare(options);
}
