#include "slam/fastslam/lamp_recognition.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace azimuth {
namespace {

/// Lamps with identities need no association.
class NoAssociator final : public LampAssociator {
 public:
  void associate(const LampPairs&, std::span<int>) override { ADD_FAILURE() << "asked although lamps have names"; }
};

/// Particles hold the same lamps in different slots, as after one particle has lost a lamp and found it again.
struct NamedLamps : testing::Test {
  static constexpr double kHeight_m = 1.8;
  static Eigen::Vector3d place(Identity name) { return {1.0 + static_cast<double>(name), 0.5, 6.5}; }

  void map(std::size_t k, const std::vector<Identity>& names) {
    for (const Identity name : names)
      particles.add_landmark(k, place(name), {1e-4, 0.0, 0.0, 1e-4, 0.0, 1e-4},
                             {.id = name, .identity = name, .near = true});
  }
  void look(const std::vector<Identity>& names) {
    const Viewpoint from(Pose2{}, kHeight_m);
    for (const Identity name : names) {
      const Eigen::Vector2d z = direction_of(view(from, place(name)), from.heading_rad);
      seen.push_back(make_sighting(z.x(), z.y(), {1e-4, 0.0, 1e-4}, name));
    }
    recognition.begin(seen);
  }
  /// The identities of the landmarks that particle k associates with the sightings.
  std::vector<Identity> recognised_by(std::size_t k) {
    NoAssociator none;
    recognition.recognise(particles, {k, Viewpoint(Pose2{}, kHeight_m), {}, {1e-6, 0.0, 0.0, 1e-6, 0.0, 1e-6}}, none);
    std::vector<Identity> names;
    for (std::size_t l = 0; l < seen.size(); ++l) {
      const ExpectedLamp* const lamp = recognition.lamp_of(l);
      names.push_back(lamp == nullptr ? kUnknownIdentity
                                      : particles.infos(k)[static_cast<std::size_t>(lamp->slot)].identity);
    }
    return names;
  }

  Particles particles{4, 8, 1};
  LampRecognition recognition{FastSlamSettings{}, {kHeight_m, kPi / 2.0, 0.85, true}, 8};
  std::vector<LampSighting> seen;
};

TEST_F(NamedLamps, AreFoundInWhateverSlotEachParticleHasThem) {
  map(0, {3, 1, 2});
  map(1, {3, 1, 2});
  map(2, {2, 3, 1, 4});
  map(3, {1});
  look({1, 2, 4});
  EXPECT_EQ(recognised_by(0), (std::vector<Identity>{1, 2, kUnknownIdentity}));
  EXPECT_EQ(recognised_by(1), (std::vector<Identity>{1, 2, kUnknownIdentity}));
  EXPECT_EQ(recognised_by(2), (std::vector<Identity>{1, 2, 4}));
  EXPECT_EQ(recognised_by(3), (std::vector<Identity>{1, kUnknownIdentity, kUnknownIdentity}));
  EXPECT_EQ(recognised_by(2), (std::vector<Identity>{1, 2, 4}));
}

TEST_F(NamedLamps, SeenTwiceInAnImageAreRecognisedOnce) {
  map(0, {2, 1});
  map(1, {1, 2});
  look({1, 1, kUnknownIdentity});
  for (const std::size_t k : {0U, 1U})
    EXPECT_EQ(recognised_by(k), (std::vector<Identity>{1, kUnknownIdentity, kUnknownIdentity}));
}

}  // namespace
}  // namespace azimuth
