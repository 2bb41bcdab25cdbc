#!/usr/bin/env python3
"""Tests which settings a sweep tries, which one it calls the best, and which sweeps it refuses.

usage: sweep_test.py SOURCE_TREE      exit code 0: good, 1: not
"""

import math
import random
import sys
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

sys.path.insert(0, str(Path(sys.argv[1]) / "tools/fleet"))
import sweep  # noqa: E402
import sweep_page  # noqa: E402
import sweep_table  # noqa: E402


def described(**changes):
    return {"azimuth": "azimuth", "settings": {"a": [1, 2], "b": [0.5, "x"]}, "criterion": "position_rmse_m", "hold_out": "night"} | changes


def values(settings, key):
    return [float(assignment.split("=")[1]) for point in settings for assignment in point if assignment.startswith(f"{key}=")]


class Settings(unittest.TestCase):
    def test_grid_has_each_with_each(self):
        self.assertEqual(sweep.settings_of(described()), [("a=1", "b=0.5"), ("a=1", "b=x"), ("a=2", "b=0.5"), ("a=2", "b=x")])
        self.assertEqual(sweep.settings_of(described(settings={"a": [True, 1e-7, 1e-7]})), [("a=true",), ("a=1e-07",)])

    def test_ranges(self):
        for sampling in ("random", "halton"):
            ranges = {"a": {"from": -2, "to": 3}, "b": {"from": 0.01, "to": 100, "log": True}, "c": {"from": 1, "to": 4, "whole": True}, "d": [5, 9]}
            settings = sweep.settings_of(described(settings=ranges, sampling=sampling, samples=400))
            self.assertEqual(len(settings), 400)
            a, b, c, d = (values(settings, key) for key in "abcd")
            self.assertTrue(all(-2 <= each < 3 for each in a) and all(0.0099 < each <= 100 for each in b))
            self.assertAlmostEqual(sum(a) / 400, 0.5, delta=0.25)      # more than three standard deviations of the mean
            self.assertAlmostEqual(sum(math.log10(each) for each in b) / 400, 0.0, delta=0.2)
            self.assertEqual((set(c), set(d)), ({1, 2, 3, 4}, {5, 9}))
            self.assertTrue(all(70 < c.count(each) < 130 for each in (1, 2, 3, 4)))

    def test_halton(self):
        self.assertEqual(sweep.halton_points(4, 2, 1), [[1 / 2, 1 / 3], [1 / 4, 2 / 3], [3 / 4, 1 / 9], [1 / 8, 1 / 3 + 1 / 9]])
        self.assertEqual(sweep.primes(7), [2, 3, 5, 7, 11, 13, 17])

    def test_halton_leaves_smaller_holes_than_random(self):
        """Compares the number of empty cells that 64 samples leave in a grid of 8 by 8, averaged over ten seeds."""
        def empty(points):
            return 64 - len({(int(8 * x), int(8 * y)) for x, y in points})
        halton = sum(empty(sweep.halton_points(64, 2, seed)) for seed in range(1, 11)) / 10
        chance = sum(empty(sweep.random_points(64, 2, seed)) for seed in range(1, 11)) / 10
        print(f"empty of 64 cells: {halton} by Halton's samples, {chance} by random ones")
        self.assertLess(halton, 0.75 * chance)

    def test_seeds(self):
        ranged = {"settings": {"a": {"from": 0, "to": 1}}, "samples": 5}
        for sampling in ("random", "halton"):
            first = sweep.settings_of(described(sampling=sampling, **ranged))
            self.assertEqual(first, sweep.settings_of(described(sampling=sampling, **ranged)))
            self.assertEqual(first, sweep.settings_of(described(sampling=sampling, **ranged | {"samples": 9}))[:5])
            self.assertNotEqual(first, sweep.settings_of(described(sampling=sampling, sampling_seed=2, **ranged)))

    def test_names_are_folders(self):
        variants = sweep.variants_of(described(settings={"a": ["x/y", "z" * 300]}, config="robot.toml", seeds=[1, 2]))
        self.assertEqual(variants["a=x_y"], {"azimuth": "azimuth", "config": "robot.toml", "seeds": [1, 2], "set": ["a=x/y"]})
        variants |= sweep.variants_of(described())
        self.assertIn("a=1+b=x", variants)
        self.assertTrue(all(not set(name) & set("/,: ") and len(name) <= 120 for name in variants), variants)

    def test_swept_settings_come_after_those_of_the_baseline(self):
        variants = sweep.variants_of(described(settings={"a": [1]}, set=["a=7", "b=8"]))
        self.assertEqual(variants["a=1"]["set"], ["a=7", "b=8", "a=1"])

    def test_mistakes(self):
        tags = [("lab",), ("lab", "night")]
        sweep.check(described(), tags)
        for changes, told in (({"setings": {}}, "setings: is none of"), ({"criterion": None}, "criterion: is missing"),
                              ({"settings": {"a": []}}, "settings: a: wants a list"), ({"settings": {"a": {"from": 1}}}, "settings: a: wants a list"),
                              ({"settings": {"a": {"from": 1, "to": 2, "lg": 1}}}, "settings: a: wants a list"),
                              ({"settings": {"a": {"from": 2, "to": 2}}}, "is no range"),
                              ({"settings": {"a": {"from": 0, "to": 2, "log": True}}}, "log wants a range"),
                              ({"samples": 0}, "samples: 0: wants a number of 1 and more"), ({"hold_out": "day"}, "is a tag of 0 of 2 runs"), ({"hold_out": "lab"}, "is a tag of 2 of 2 runs"),
                              ({"sampling": "sobol"}, "is none of grid, random, halton"),
                              ({"settings": {"a": {"from": 1, "to": 2}}}, "a grid wants values")):
            with self.assertRaises(sweep.Mistake) as caught:
                sweep.check(described(**changes), tags)
                sweep.settings_of(described(**changes))
            self.assertIn(told, str(caught.exception))


FIGURE = {"key": "position_rmse_m", "label": "position RMSE", "unit": "m", "shown_factor": 1.0, "decimals": 3, "by_ratio": True}


def comparison(change, pairs=6, failed=()):
    found = {"before": 0.1, "after": 0.1 * (1 + change), "change": change, "low": change - 0.02, "high": change + 0.02, "pairs": pairs}
    return {"figures": [FIGURE], "groups": [{"tag": "lab", "figures": {}}, {"tag": None, "figures": {"position_rmse_m": found}}],
            "absent": {"failed": list(failed)}}


class Choice(unittest.TestCase):
    def test_lowest_change_is_the_best(self):
        changes = {f"a={each}": each / 100 for each in random.Random(1).sample(range(-50, 50), 20)}
        choice = sweep_table.chosen({name: comparison(change) for name, change in changes.items()}, "position_rmse_m")
        self.assertEqual(choice["best"], min(changes, key=changes.get))
        self.assertEqual([each["settings"] for each in choice["settings"]], sorted(changes, key=changes.get))

    def test_setting_that_fails_on_some_runs_is_none_to_choose(self):
        choice = sweep_table.chosen({"a=1": comparison(-0.9, pairs=5), "a=2": comparison(0.3), "a=3": comparison(0.2)}, "position_rmse_m")
        self.assertEqual([each["settings"] for each in choice["settings"]], ["a=3", "a=2", "a=1"])
        text = sweep_table.text(sweep_table.tested(choice, comparison(0.1), "night"))
        self.assertIn("a=1                0.010 m  was    0.100 m    -90.0 % [-92.0 %, -88.0 %]  on 5 of 6 runs: none to choose\n", text)
        self.assertIn("a=3 (held out)     0.110 m  was    0.100 m    +10.0 % [+8.0 %, +12.0 %]\n", text)
        self.assertIn("held out    6 runs with tag night: worse than the baseline\n", text)

    def test_verdict_is_of_what_was_held_out(self):
        choice = sweep_table.chosen({"a=1": comparison(-0.1)}, "position_rmse_m")
        for held_out, told in ((comparison(-0.1), "better than the baseline"), (comparison(0.1), "worse than the baseline"),
                               (comparison(-0.01), "neither better nor worse"), (comparison(-0.1, pairs=5), "too few to tell")):
            self.assertIn(f"with tag night: {told}", sweep_table.text(sweep_table.tested(choice, held_out, "night")))

    def test_nothing_measured(self):
        nothing = comparison(0.0, pairs=0)
        with self.assertRaisesRegex(sweep.Mistake, "position_rmse_m: is measured on no run"):
            sweep_table.chosen({"a=1": nothing}, "position_rmse_m")
        with self.assertRaisesRegex(sweep.Mistake, "beauty: is none of position_rmse_m"):
            sweep_table.chosen({"a=1": comparison(0.0)}, "beauty")

    def test_best_that_fails_on_what_was_held_out(self):
        choice = sweep_table.chosen({"a=1": comparison(-0.1)}, "position_rmse_m")
        held_out = comparison(0.0, pairs=0, failed=[{"name": "run9", "why": "killed by SIGSEGV"}])
        text = sweep_table.text(sweep_table.tested(choice, held_out, "night"))
        self.assertIn("failed      run9: killed by SIGSEGV\n", text)
        self.assertIn("a=1 (held out)  not measured\n", text)


class Page(unittest.TestCase):
    def page(self, comparisons, sets):
        choice = sweep_table.chosen(comparisons, "position_rmse_m")
        for each in choice["settings"]:
            each["set"] = sets[each["settings"]]
        return sweep_page.page(sweep_table.tested(choice, comparison(-0.05), "night"))

    def test_plots_each_key(self):
        sets = {f"s{at}": [f"a={at}", f"b={'x<' if at % 2 else 'y'}"] for at in range(1, 6)}
        page = self.page({name: comparison(0.1 * at, pairs=5 if at == 4 else 6) for at, name in enumerate(sets)}, sets)
        document = xml.fromstring(page[page.index("<svg"):page.rindex("</svg>") + 6].join(("<all>", "</all>")))
        plots = document.findall("svg")
        self.assertEqual([each.get("aria-label") for each in plots], ["a", "b"])
        for plot in plots:
            kinds = [group.get("class") for group in plot.findall("g")]
            self.assertEqual((len(kinds), kinds.count("best"), kinds.count("held"), kinds.count("out")), (6, 1, 1, 1))
        heights = {group.find("title").text: float(group.find("circle").get("cy")) for group in plots[0].findall("g")}
        self.assertEqual(sorted(heights, key=heights.get, reverse=True), ["s1 (held out)", "s1", "s2", "s3", "s4", "s5"], "the lowest is the best")
        self.assertIn("x&lt;", page)

    def test_places(self):
        place, ticks = sweep_page.horizontal(["0.1", "10", "1", "10"])
        self.assertAlmostEqual(place("1"), (place("0.1") + place("10")) / 2, msg="by factors")
        self.assertEqual([label for _, label in ticks], ["0.1", "1", "10"])
        place, _ = sweep_page.horizontal(["-1", "0", "1"])
        self.assertAlmostEqual(place("0"), (place("-1") + place("1")) / 2)
        for alone in (["3"], ["x"]):
            place, ticks = sweep_page.horizontal(alone)
            self.assertTrue(sweep_page.LEFT < place(alone[0]) < sweep_page.WIDE)
        for values in ([0.0], [0.0, 1e-5], [-3.0, 0.0, 2.0], [0.0, 4e6]):
            place, ticks = sweep_page.vertical(values)
            self.assertTrue(2 <= len(ticks) <= 7, ticks)
            self.assertTrue(all(sweep_page.ABOVE <= place(each) <= sweep_page.HIGH - sweep_page.BELOW for each in (*values, *ticks)))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
