"""Makes the tables of docs/results.md and README.md from the numbers of numbers_kept.py."""

from statistics import mean

MRCLAM = [f"data/mrclam6-robot{robot}" for robot in (1, 2, 3)]
COURSE, LAB, ALIKE, OFFICE, HALL = "data/course-301", "runs/lab", "runs/alike", "data/office-a", "data/hall-a"
NEWCOMERS = {"data/lostwoods-c": ("Lost in the Woods, part C", "the laser is 4.6° askew"), "data/mrclam9-robot3": ("MRCLAM 9, robot 3", "turns are 35 % off"),
             "data/dlr-circles-a": ("DLR circles, part A", "distances are 7 to 8 % off"), "data/victoria-a": ("Victoria Park, 386 s", "one tree or none at a time")}
LAB_RUNS, HALL_RUNS = "data/lab-runs/", "data/hall-runs/"     # prefixes of the names of groups of runs
SEVERAL = {LAB_RUNS: "lab, {} recorded runs, mean", HALL_RUNS: "halls, 16 lamps, {} runs, mean"}     # {}: number of runs
CALLED = {COURSE: "course-301", LAB: "lab, three laps, `runs/lab`", ALIKE: "lab, one lap, `runs/alike`", HALL: "hall, 14 lamps, images (ray-traced)",
          "runs/lamps": "half a minute below 32 lamps, images, `runs/lamps`", "runs/mirror": "37 images of a mirror camera, 24 cylinders, `runs/mirror`"}
CALLED |= {run: f"MRCLAM 6, robot {run[-1]}" for run in MRCLAM} | {run: called for run, (called, _) in NEWCOMERS.items()} | SEVERAL


class Numbers:
    """The numbers of one variant."""

    def __init__(self, runs):
        self.runs = runs

    def all(self, run, name):
        """The values of all seeds of a run, or of a group of runs."""
        found = [numbers[name] for key, numbers in self.runs.items() if name in numbers and (key == run or key.startswith(run + ", seed ")
                                                                                            or run in SEVERAL and key.startswith(run))]
        return found

    def called(self, run):
        """The name of a run in a table; a group has its number of runs."""
        return CALLED[run].format(len({key.partition(", seed ")[0] for key in self.runs if key.startswith(run)}))

    def mean(self, run, name):
        found = self.all(run, name)
        return mean(found) if found else None

    def count(self, run, name, other):
        """The number of runs in which the number `name` is greater than the number `other`."""
        return sum(first > second for first, second in zip(self.all(run, name), self.all(run, other)))


def metres(number):
    return "" if number is None else f"{number:.3f}" if number < 0.0995 else f"{number:.2f}"


def ratio(number):
    return "" if number is None else f"{number:.1f}" if number < 99.5 else f"{number:.0f}"


def with_anees(variant, run, error="rmse_m", anees="anees"):
    found = variant.mean(run, error)
    return "" if found is None else f"{metres(found)} ({ratio(variant.mean(run, anees))})"


def of_several(total):
    return f"{total:.1f}".removesuffix(".0")


def in_map(of, run):
    """The numbers of matched and of true landmarks."""
    phantoms = of.mean(run, "phantoms")
    counted = f"{of_several(of.mean(run, 'found'))} of {of_several(of.mean(run, 'of'))}, {of_several(of.mean(run, 'twice'))} twice"
    return counted if phantoms is None else f"{counted}, {of_several(phantoms)} of nothing"


def table(head, rows):
    lines = [f"| {' | '.join(line)} |\n".replace("|  |", "| |").replace("|  |", "| |") for line in (head, *rows)]
    return lines[0] + "|---" * len(head) + "|\n" + "".join(lines[1:])


def bearings(of):
    rows = []
    for run, what in ((MRCLAM[0], "real, 760 s, forward camera ±30°"), (MRCLAM[1], "real, 886 s"), (MRCLAM[2], "real, 887 s"),
                      (COURSE, "simulated by others, 301 poses, 141 landmarks, odometry that slips")):
        ekf, apart = of["ekf"], of["ekf-no-names"]
        rows.append([ekf.called(run), what, f"{metres(ekf.mean(run, 'odometry_raw_m'))} / {metres(ekf.mean(run, 'odometry_m'))}", metres(ekf.mean(run, "rmse_m")),
                     ratio(ekf.mean(run, "anees")), metres(apart.mean(run, "rmse_m"))])
    for name, variant, what in (("", "ekf", "simulated, 36 steps, 24 landmarks"), (', `preset = "paper"`', "paper", "the paper's own thresholds, no gate")):
        ekf = of[variant]
        rows.append([f"{ekf.called(LAB_RUNS).removesuffix(', mean')}{name}, mean of the mean error", what, metres(ekf.mean(LAB_RUNS, "odometry_mean_m")), metres(ekf.mean(LAB_RUNS, "mean_m")),
                     ratio(ekf.mean(LAB_RUNS, "anees")), ""])
    return table(["run", "what", "odometry, raw / calibrated", "EKF, identities known", "ANEES", "EKF, identities unknown"], rows)


def smoother(of):
    found = of["smoother"]
    return table(["run", "live", "ANEES", "in hindsight", "ANEES"],
                 [[found.called(run), metres(found.mean(run, "rmse_m")), ratio(found.mean(run, "anees")), metres(found.mean(run, "hindsight_m")),
                   ratio(found.mean(run, "hindsight_anees"))] for run in (*MRCLAM, COURSE, LAB_RUNS, LAB)])


def newcomers(of):
    rows = []
    for variant, which, names in (("smoother", NEWCOMERS, ""), ("smoother-no-names", ["data/lostwoods-c"], ", without names")):
        found = of[variant]
        rows += [[found.called(run) + names, NEWCOMERS[run][1], metres(found.mean(run, "odometry_m")), with_anees(of["ekf"], run) if not names else "",
                  with_anees(found, run, anees="anees_tracking"), with_anees(found, run, "hindsight_m", "hindsight_anees"), f"{100 * found.mean(run, 'tracking'):.0f} %"] for run in which]
    return table(["drive", "what the rig does not say", "odometry", "EKF (ANEES)", "smoother live (ANEES while `tracking`)", "in hindsight (ANEES)", "`tracking`"], rows)


def no_names(of):
    ekf, smooth = of["ekf-no-names"], of["smoother-no-names"]
    rows = []
    for run in (LAB_RUNS, LAB, ALIKE, COURSE, *MRCLAM):
        worse = smooth.count(run, "rmse_m", "odometry_m")
        live = with_anees(smooth, run) + (f", worse than odometry in {worse}" if worse and run in SEVERAL else "")
        rows.append([smooth.called(run), metres(smooth.mean(run, "odometry_m")), with_anees(ekf, run), live, with_anees(smooth, run, "hindsight_m", "hindsight_anees"),
                     in_map(smooth, run),
                     f"{100 * smooth.mean(run, 'tracking'):.0f} %"])
    return table(["run", "odometry", "EKF (ANEES)", "smoother live (ANEES)", "in hindsight (ANEES)", "landmarks", "`tracking`"], rows)


def shipped(of):
    found = of["default"]
    rows = [[found.called(run), f"`{found.runs[run]['estimator']}`", metres(found.mean(run, "odometry_m")), with_anees(found, run),
             with_anees(found, run, "hindsight_m", "hindsight_anees"), in_map(found, run)]
            for run in (LAB, ALIKE, "runs/mirror", "runs/lamps")]
    return table(["run", "estimator", "odometry", "live (ANEES)", "in hindsight (ANEES)", "landmarks"], rows)


def images(of):
    rows = []
    for variant, called in (("colour", "coloured cylinders"), ("sift", "SIFT, told apart by geometry"), ("sift-patterns", "SIFT, told apart by patterns")):
        found = {name: of[variant].mean(OFFICE, name) for name in ("rmse_m", "anees", "landmarks", "found", "of", "twice", "landmarks_mean_m", "wrong", "judged")}
        in_map = f"{found['landmarks']} features" if found["found"] is None else \
            f"{found['found']} of {found['of']}, mean {metres(found['landmarks_mean_m'])} m, {found['twice']} twice, {found['landmarks']} in all"
        rows.append([called, f"{metres(found['rmse_m'])} m", ratio(found["anees"]), in_map, f"{found['wrong']} of {found['judged']}"])
    return table(["front end", "position RMSE", "ANEES", "map", "wrong identities"], rows)


def lamps(of):
    ekf, particles = of["lamp-ekf"], of["fastslam"]
    rows = []
    for run in (HALL_RUNS, HALL):
        errors = particles.all(run, "mean_m")
        rows.append([ekf.called(run), metres(ekf.mean(run, "odometry_mean_m")), with_anees(ekf, run, "mean_m"),
                     in_map(ekf, run),
                     f"{with_anees(particles, run, 'mean_m')}, {metres(min(errors))} to {metres(max(errors))}",
                     in_map(particles, run)])
    return table(["run", "odometry", "one EKF (ANEES)", "its lamps", f"FastSLAM (ANEES), {len(particles.all(HALL, 'mean_m'))} seeds", "its lamps"], rows)


def readme(of):
    def three(variant, name):
        return ", ".join(f"{of[variant].mean(run, name):.2f}" for run in MRCLAM)

    def two(variant, run, name):
        return f"{of[variant].mean(run, name):.2f}"
    return table(["drive", "odometry alone", "Azimuth"], [
        ["real, 13 to 15 minutes, forward camera ±30°, landmarks with names (MRCLAM 6, three robots)", three("smoother", "odometry_raw_m"), three("smoother", "rmse_m")],
        ["images of a mirror camera, two laps round an office block: coloured cylinders / natural features", two("colour", OFFICE, "odometry_m"),
         f"{two('colour', OFFICE, 'rmse_m')} / {two('sift', OFFICE, 'rmse_m')}"],
        ["images of a fisheye below 14 lamps that all look alike, 85 m", two("lamp-ekf", HALL, "odometry_m"), two("lamp-ekf", HALL, "rmse_m")],
        [f"simulated lab, 36 stops, 24 landmarks, {len(of['ekf'].all(LAB_RUNS, 'mean_m'))} drives, mean error", two("ekf", LAB_RUNS, "odometry_mean_m"), two("ekf", LAB_RUNS, "mean_m")]])


TABLES = {table.__name__: table for table in (bearings, smoother, newcomers, no_names, shipped, images, lamps, readme)}


def made_of(numbers):
    """Makes all tables: {name: Markdown}."""
    of = {variant: Numbers(runs) for variant, runs in numbers.items()}
    return {name: make(of) for name, make in TABLES.items()}
