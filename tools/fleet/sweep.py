"""Makes the settings of a sweep: a grid of values, or random or Halton samples of values and ranges."""

import itertools
import math
import random

from corpus import digest, unusable_name

DEFAULTS = {"criterion": "position_rmse_m"}
KEYS = {"azimuth", "config", "set", "options", "tags", "seeds", "settings", "sampling", "samples", "sampling_seed", "criterion", "hold_out"}
RANGE_KEYS = {"from", "to", "log", "whole"}


class Mistake(Exception):
    """An error in the description of a sweep."""


def check(sweep, tags):
    """Checks a sweep; `tags` has the tags of each run of the corpus."""
    for key in sorted(set(sweep) - KEYS):
        raise Mistake(f"{key}: is none of {', '.join(sorted(KEYS))}")
    for key in ("azimuth", "settings", "criterion", "hold_out"):
        if not sweep.get(key):
            raise Mistake(f"{key}: is missing")
    held_out = sum(sweep["hold_out"] in each for each in tags)
    if held_out in (0, len(tags)):
        raise Mistake(f"hold_out: {sweep['hold_out']}: is a tag of {held_out} of {len(tags)} runs, and some must have it and some not")
    if not isinstance(sweep.get("samples", 20), int) or sweep.get("samples", 20) < 1:
        raise Mistake(f"samples: {sweep['samples']}: wants a number of 1 and more")
    for key, values in sweep["settings"].items():
        check_values(key, values)


def check_values(key, values):
    if isinstance(values, list) and values:
        return
    if not isinstance(values, dict) or not {"from", "to"} <= set(values) <= RANGE_KEYS:
        raise Mistake(f"settings: {key}: wants a list of values or {{from, to}}, with log or whole if need be")
    if not values["from"] < values["to"]:
        raise Mistake(f"settings: {key}: from {values['from']} to {values['to']} is no range")
    if values.get("log") and (values["from"] <= 0 or values.get("whole")):
        raise Mistake(f"settings: {key}: log wants a range of real numbers above 0")


def settings_of(sweep):
    """Lists of unique KEY=VALUE in the order of sampling, so that more samples keep the first ones."""
    settings = sweep["settings"]
    sampling = sweep.get("sampling", "grid")
    if sampling == "grid":
        ranges = [key for key, values in settings.items() if isinstance(values, dict)]
        if ranges:
            raise Mistake(f"settings: {ranges[0]}: a grid wants values; sampling random or halton takes ranges")
        points = itertools.product(*settings.values())
    elif sampling in ("random", "halton"):
        of = random_points if sampling == "random" else halton_points
        points = ([value_at(values, part) for values, part in zip(settings.values(), parts)]
                  for parts in of(sweep.get("samples", 20), len(settings), sweep.get("sampling_seed", 1)))
    else:
        raise Mistake(f"sampling: {sampling}: is none of grid, random, halton")
    return list(dict.fromkeys(tuple(f"{key}={text_of(value)}" for key, value in zip(settings, point)) for point in points))


def variants_of(sweep):
    """The variants of a sweep, keyed by names that corpus.unusable_name accepts."""
    rest = {key: sweep[key] for key in ("azimuth", "config", "options", "tags", "seeds") if key in sweep}
    return {name_of(settings): rest | {"set": [*sweep.get("set", []), *settings]} for settings in settings_of(sweep)}


def name_of(settings):
    name = "".join("_" if unusable_name(letter) else letter for letter in "+".join(settings))
    return name if len(name) <= 120 else f"{name[:100]}-{digest(name)}"


def random_points(count, dimensions, seed):
    numbers = random.Random(seed)
    return [[numbers.random() for _ in range(dimensions)] for _ in range(count)]


def halton_points(count, dimensions, seed):
    """Halton points cover the space more evenly than random ones. The seed selects the start in the sequence."""
    return [[radical_inverse(index, base) for base in primes(dimensions)] for index in range(seed, seed + count)]


def radical_inverse(index, base):
    """Mirrors the digits of `index` at the point: 6 = 110 in base 2 gives 0.011, which is 0.375."""
    inverse, place = 0.0, 1.0 / base
    while index:
        index, digit = divmod(index, base)
        inverse += digit * place
        place /= base
    return inverse


def primes(count):
    found = []
    for number in itertools.count(2):
        if len(found) == count:
            return found
        if all(number % prime for prime in found):
            found.append(number)


def value_at(values, part):
    """The value at the fraction `part` in [0, 1) of the values or of the range."""
    if isinstance(values, list):
        return values[int(part * len(values))]
    low, high = values["from"], values["to"]
    if values.get("whole"):
        return low + int(part * (high - low + 1))
    if values.get("log"):
        return math.exp(math.log(low) + part * (math.log(high) - math.log(low)))
    return low + part * (high - low)


def text_of(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:.6g}" if isinstance(value, float) else str(value)
