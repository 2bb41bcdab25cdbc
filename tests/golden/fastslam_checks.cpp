#include <gtest/gtest.h>

#include "slam/fastslam/cross_point.hpp"
#include "slam/fastslam/lamp_likelihood.hpp"
#include "slam/fastslam/lamp_update.hpp"
#include "slam/fastslam/particles.hpp"
#include "slam/particles/lamp_association.hpp"
#include "tests/golden/checks.hpp"

namespace azimuth::golden {
namespace {

using nlohmann::json;

constexpr double kPaperGate = 8.0;

Symmetric3 to_symmetric3(const json& rows) { return Symmetric3::of(to_matrix(rows)); }

/// The particle, its map and an image, as most cases of part II give them.
struct Scene {
  double height_m;
  Viewpoint x_hat;
  Symmetric3 R;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Symmetric3> covariances;
  std::vector<LampSighting> sightings;

  explicit Scene(const json& input)
      : height_m(input.at("hcam")), x_hat(to_vector(input.at("xhat")), height_m), R(to_symmetric3(input.at("R"))) {
    for (const json& mu : input.at("mu")) positions.emplace_back(to_vector(mu));
    for (const json& Sigma : input.at("Sigma")) covariances.push_back(to_symmetric3(Sigma));
    for (std::size_t l = 0; l < input.at("Z").size(); ++l)
      sightings.push_back(make_sighting(input.at("Z").at(l).at(0), input.at("Z").at(l).at(1),
                                        Symmetric2::of(to_matrix(input.at("Q").at(l)))));
  }
  ExpectedLamp lamp(std::size_t j) const { return expect(x_hat, R, positions[j], covariances[j]); }
  Symmetric2 Q(std::size_t l, std::size_t j) const { return lamp(j).of_point + sightings[l].covariance; }
  Eigen::Vector2d nu(std::size_t l, std::size_t j) const { return innovation(lamp(j).view, x_hat, sightings[l]); }
};

void expect_proposal(const PoseProposal& proposal, const json& expected, double tolerance, const char* what) {
  expect_near(proposal.mean(), to_vector(expected.at("mu")), tolerance, what);
  expect_near(proposal.covariance().matrix(), to_matrix(expected.at("Sigma")), tolerance, what);
}

/// The rays of a candidate that is seen from one pose after the other.
std::vector<Ray> rays_of(const json& input, const std::vector<LampSighting>& sightings) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < sightings.size(); ++i)
    rays.push_back({Viewpoint(to_vector(input.at("poses").at(i)), input.at("hcam")), &sightings[i]});
  return rays;
}

}  // namespace

void check_h3(const GoldenCase& golden) {
  const Viewpoint from(to_vector(golden.input.at("x")), golden.input.at("hcam"));
  const LampView v = view(from, to_vector(golden.input.at("m")));
  expect_near(direction_of(v, from.heading_rad), to_vector(golden.expected.at("z")), golden.tolerance, "z");
  expect_near(v.H_x(), to_matrix(golden.expected.at("Hx")), golden.tolerance, "Hx");
  expect_near(v.H_m(), to_matrix(golden.expected.at("Hm")), golden.tolerance, "Hm");
}

void check_fs_likelihood(const GoldenCase& golden) {
  const Scene scene(golden.input);
  for (std::size_t l = 0; l < scene.sightings.size(); ++l) {
    const LampSighting& seen = scene.sightings[l];
    expect_near(log_new(seen, kPaperGate), golden.expected.at("ln_P_new").at(l), golden.tolerance, "ln P_new");
    for (std::size_t j = 0; j < scene.positions.size(); ++j) {
      const std::string what = std::to_string(l) + ", " + std::to_string(j);
      expect_near(log_likelihood_marginal(scene.lamp(j), innovation(scene.lamp(j).view, scene.x_hat, seen), seen),
                  golden.expected.at("ln_phi_marginal").at(l).at(j), golden.tolerance, "marginal " + what);
      expect_near(log_likelihood_paper(scene.lamp(j), scene.x_hat, scene.R, scene.positions[j], seen),
                  golden.expected.at("ln_phi_paper").at(l).at(j), golden.tolerance, "paper " + what);
    }
  }
}

void check_assoc(const GoldenCase& golden) {
  const auto log_new = golden.input.at("ln_P_new").get<std::vector<double>>();
  std::vector<LampPair> pairs;
  for (std::size_t l = 0; l < log_new.size(); ++l)
    for (std::size_t j = 0; j < golden.input.at("ln_phi").at(l).size(); ++j)
      if (const double log_phi = golden.input.at("ln_phi").at(l).at(j); log_phi > log_new[l])
        pairs.push_back({static_cast<int>(l), static_cast<int>(j), log_phi});
  LampAssociation association(LampAssociationMethod::hungarian, LampCost::logarithm);
  std::vector<int> psi(log_new.size());
  association.associate({pairs, log_new, golden.input.at("ln_phi").at(0).size()}, psi);
  EXPECT_EQ(psi, golden.expected.at("psi").get<std::vector<int>>());
}

void check_alg3(const GoldenCase& golden) {
  const Scene scene(golden.input);
  PoseProposal linear(scene.x_hat.pose(), scene.R), relinearised = linear;
  for (std::size_t step = 0; step < golden.expected.at("relinearised").size(); ++step) {
    const json& expected = golden.expected.at("relinearised").at(step);
    const json& expected_linear = golden.expected.at("linear_at_xhat").at(step);
    const std::size_t j = expected.at("landmark"), l = j;  // the cases pair sighting l with landmark j = l
    ASSERT_EQ(golden.input.at("pairs").at(l).at(1), j);
    relinearised.add_relinearised(scene.positions[j], scene.covariances[j], scene.sightings[l], scene.height_m);
    expect_proposal(relinearised, expected, golden.tolerance, "relinearised");
    linear.add(scene.lamp(j).view, scene.nu(l, j), scene.Q(l, j));
    expect_proposal(linear, expected_linear, golden.tolerance, "linear");
  }
}

void check_alg4(const GoldenCase& golden) {
  const json& input = golden.input;
  const Viewpoint x_t(to_vector(input.at("x")), input.at("hcam"));
  const LampSighting seen =
      make_sighting(input.at("z").at(0), input.at("z").at(1), Symmetric2::of(to_matrix(input.at("Q"))));
  Eigen::Vector3d mu = to_vector(input.at("mu"));
  Symmetric3 Sigma = to_symmetric3(input.at("Sigma"));
  expect_near(log_weight_paper(x_t, to_symmetric3(input.at("R")), seen, mu, Sigma), golden.expected.at("ln_w_paper"),
              golden.tolerance, "ln w");
  correct(x_t, seen, mu, Sigma);
  expect_near(mu, to_vector(golden.expected.at("mu1")), golden.tolerance, "mu");
  expect_near(Sigma.matrix(), to_matrix(golden.expected.at("Sigma1")), golden.tolerance, "Sigma");
}

void check_joint_weight(const GoldenCase& golden) {
  const Scene scene(golden.input);
  PoseProposal proposal(scene.x_hat.pose(), scene.R);
  for (std::size_t j = 0; j < scene.positions.size(); ++j)
    proposal.add(scene.lamp(j).view, scene.nu(j, j), scene.Q(j, j));
  expect_near(proposal.log_likelihood(), golden.expected.at("ln_w"), golden.tolerance, "ln w");
}

void check_counter(const GoldenCase& golden) {
  const auto seen = golden.input.at("seen").get<std::vector<int>>();
  CandidateCounter counter;
  std::vector<int> counts{counter.count};
  std::size_t i = 1;
  for (bool lives = true; lives && i < seen.size(); ++i) {
    if (seen[i] != 0)
      counter.seen();
    else
      lives = counter.missed();
    counts.push_back(counter.count);
    if (!lives) break;
  }
  EXPECT_EQ(counts, golden.expected.at("i").get<std::vector<int>>());
  EXPECT_EQ(i, golden.expected.at("deleted_at").get<std::size_t>());
}

void check_crosspoint(const GoldenCase& golden) {
  const json &input = golden.input, &expected = golden.expected;
  const LampSighting z1 = make_sighting(input.at("z1").at(0), input.at("z1").at(1), {1.0, 0.0, 1.0});
  const LampSighting z2 = make_sighting(input.at("z2").at(0), input.at("z2").at(1), {1.0, 0.0, 1.0});
  const double height_m = input.at("hcam");
  const auto met = crossing({Viewpoint(to_vector(input.at("x1")), height_m), &z1},
                            {Viewpoint(to_vector(input.at("x2")), height_m), &z2});
  ASSERT_EQ(!met, expected.at("parallel").get<bool>());
  if (!met) return;
  expect_near(met->p_map, to_vector(expected.at("point")), golden.tolerance, "point");
  expect_near(met->along_first_m, expected.at("s1"), golden.tolerance, "s1");
  expect_near(met->along_second_m, expected.at("s2"), golden.tolerance, "s2");
  expect_near(met->gap_m, expected.at("gap"), golden.tolerance, "gap");
  expect_near(met->angle_rad, expected.at("angle"), golden.tolerance, "angle");
  EXPECT_EQ(met->angle_rad > degrees_to_rad(7.0), expected.at("valid_angle_7deg").get<bool>());
  EXPECT_EQ(met->angle_rad > 1.22, expected.at("valid_angle_70deg").get<bool>());
  EXPECT_EQ(met->p_map.z() > height_m, expected.at("valid_height").get<bool>());
  EXPECT_EQ(met->along_first_m > 0.0 && met->along_second_m > 0.0, expected.at("valid_cheirality").get<bool>());
}

void check_cand_init(const GoldenCase& golden) {
  const json& input = golden.input;
  CrossingRules rules;
  rules.min_parallax_rad = input.contains("ang_min_rad") ? input.at("ang_min_rad").get<double>()
                                                         : degrees_to_rad(input.at("ang_min_deg").get<double>());
  rules.min_sightings = input.at("nz_min");
  rules.min_points = input.at("ncross");
  const Symmetric2 Q = Symmetric2::of(to_matrix(input.at("Q")));
  std::vector<LampSighting> sightings;
  for (const json& z : input.at("Z")) sightings.push_back(make_sighting(z.at(0), z.at(1), Q));
  const std::vector<Ray> rays = rays_of(input, sightings);
  CrossPoints points;
  for (std::size_t n = 1; n <= rays.size(); ++n) {
    points.observe(std::span(rays).first(n), rules);
    const json& expected = golden.expected.at(n - 1);
    EXPECT_EQ(points.valid(), expected.at("valid").get<std::size_t>()) << n;
    EXPECT_EQ(points.with_current(), expected.at("with_current").get<std::size_t>()) << n;
    EXPECT_EQ(points.suffice(n, rules), expected.at("init").get<bool>()) << n;
  }
}

void check_resample(const GoldenCase& golden) {
  const auto weights = golden.input.at("w").get<std::vector<double>>();
  std::vector<std::size_t> source(weights.size());
  low_variance(weights, golden.input.at("r"), source);
  EXPECT_EQ(source, golden.expected.get<std::vector<std::size_t>>());
}

}  // namespace azimuth::golden
