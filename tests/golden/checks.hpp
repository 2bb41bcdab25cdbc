#pragma once
// One check per kind of golden case. Each compares what the program computes from `input` with `expected`.

#include "tests/golden/golden_case.hpp"

namespace azimuth::golden {

// geometry_checks.cpp
void check_wrap(const GoldenCase& golden);
void check_control(const GoldenCase& golden);
void check_motion(const GoldenCase& golden);
void check_const(const GoldenCase& golden);
void check_halton(const GoldenCase& golden);
void check_align(const GoldenCase& golden);
void check_pairdist(const GoldenCase& golden);

// ekf_checks.cpp
void check_clone(const GoldenCase& golden);
void check_bearing(const GoldenCase& golden);
void check_ekf_update(const GoldenCase& golden);

// triangulation_checks.cpp
void check_intersect(const GoldenCase& golden);
void check_intersect_reject(const GoldenCase& golden);
void check_kl(const GoldenCase& golden);

// association_checks.cpp
void check_ratio(const GoldenCase& golden);
void check_view_interval(const GoldenCase& golden);
void check_pattern(const GoldenCase& golden);

// assignment_checks.cpp
void check_hungarian(const GoldenCase& golden);

// colour_checks.cpp
void check_polar(const GoldenCase& golden);
void check_compactness(const GoldenCase& golden);

// camera_checks.cpp
void check_camera(const GoldenCase& golden);

// fastslam_checks.cpp
void check_h3(const GoldenCase& golden);
void check_fs_likelihood(const GoldenCase& golden);
void check_assoc(const GoldenCase& golden);
void check_alg3(const GoldenCase& golden);
void check_alg4(const GoldenCase& golden);
void check_joint_weight(const GoldenCase& golden);
void check_counter(const GoldenCase& golden);
void check_crosspoint(const GoldenCase& golden);
void check_cand_init(const GoldenCase& golden);
void check_resample(const GoldenCase& golden);

// ekf_run_check.cpp
void check_ekf_run(const GoldenCase& golden);

}  // namespace azimuth::golden
