#include "settings/configuration_sections.hpp"

namespace azimuth {

Section smoother_section(HindsightSettings& smoother) {
  return {
      "smoother",
      "Path and map by everything seen so far, with estimator = \"smoother\".",
      {everyday({"names",
                 &smoother.names,
                 "Believe the names that bearings carry, where the rig says identities = true; false: tell landmarks "
                 "apart by where they are.",
                 {}}),
       everyday({"doubt_rig",
                 &smoother.doubt_rig,
                 "Believe what the rig says of odometer and camera as well as its sigma_... say, until the drive "
                 "contradicts it, and take bearings and odometry for as noisy as they are, where landmarks have names; "
                 "false: always believe the rig.",
                 {}}),
       {"consider_distance",
        &smoother.consider_distance,
        "The rig's sigma_scale_distance is in the covariance; false: the scale of distance is exact.",
        {}},
       everyday({"thinning_s", &smoother.thinning_s, "At most one bearing per named landmark in this time; 0: use all.",
                 from_to(0, 60)}),
       everyday({"nameless_thinning_s", &smoother.nameless_thinning_s,
                 "Without names: at most one image in this time; 0: use all.", from_to(0, 60)}),
       {"replant_after", &smoother.replant_after,
        "A named landmark whose bearings have not fitted so often in a row, in images whose others did, is looked for "
        "anew; 0: never.",
        from_to(0, 100000)},
       {"confirm_after_bearings", &smoother.confirm_after_bearings,
        "A landmark of fewer bearings is neither published nor saved.", from_to(1, 1000)},
       {"inverse_depth_mean_per_m", &smoother.inverse_depth_mean_per_m, "First guess of 1 / distance of a landmark.",
        above_to(0, 100)},
       {"inverse_depth_sigma_per_m", &smoother.inverse_depth_sigma_per_m,
        "Standard deviation of the first guess of 1 / distance.", above_to(0, 100)},
       choice<RobustKernel>(
           "kernel", smoother.kernel,
           {{"cauchy", RobustKernel::cauchy}, {"huber", RobustKernel::huber}, {"dcs", RobustKernel::dcs}},
           "How little bearings that fit badly are listened to. Without names hypotheses differ in "
           "it."),
       {"kernel_width", &smoother.kernel_width, "Standard deviations beyond which a bearing fits badly.",
        above_to(0, 100)},
       {"several",
        &smoother.several,
        "Follow a second member, of named landmarks, that listens less to bearings that fit badly, and believe the one "
        "with the "
        "lower energy; half the time without.",
        {}},
       {"max_iterations", &smoother.max_iterations, "Iterations of the solution at each image at most.",
        from_to(1, 100)},
       {"max_keyframes", &smoother.max_keyframes,
        "Images of named landmarks that are kept; of more those are forgotten that are worth least, unless landmarks "
        "need them, so "
        "that "
        "a drive may last for hours; 0: none. An image then costs more the longer the drive is.",
        from_to(0, 1000000)},
       {"nameless_max_keyframes", &smoother.nameless_max_keyframes,
        "Images of landmarks without names that each hypothesis keeps, of a camera that sees all round; of a narrower "
        "one as many more as each shows less. Of more those are forgotten that are worth least; 0: none.",
        from_to(0, 1000000)},
       {"members", &smoother.members,
        "Hypotheses followed side by side where bearings have no names; 0: 16 where the camera sees all round, 8 in a "
        "narrow view.",
        from_to(0, 256)},
       everyday({"threads", &smoother.threads,
                 "Threads of the daemon that look after hypotheses; the estimates are the same with any number.",
                 from_to(1, 64)})}};
}

}  // namespace azimuth
