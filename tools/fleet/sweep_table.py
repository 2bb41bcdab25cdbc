"""Finds the best setting of a sweep by a criterion on the training runs, and judges it on the held-out runs."""

from sweep import Mistake

ALL_RUNS = None     # tag of the group with all runs
NUMBERS = ("before", "after", "change", "low", "high", "pairs")
FEWEST_TO_JUDGE = 6     # number of runs; the average of fewer runs proves nothing


def outcome(comparison, criterion):
    """The result of a criterion in the JSON of `azimuth report compare`."""
    if criterion not in [figure["key"] for figure in comparison["figures"]]:
        raise Mistake(f"criterion: {criterion}: is none of {', '.join(figure['key'] for figure in comparison['figures'])}")
    group = next((group for group in comparison["groups"] if group["tag"] is ALL_RUNS), {"figures": {}})
    found = group["figures"].get(criterion, {"pairs": 0})
    return {number: found.get(number) for number in NUMBERS} | {"failed": comparison["absent"]["failed"]}


def chosen(comparisons, criterion):
    """Chooses the best setting; `comparisons` are keyed by the names of the settings. A positive change is worse for
    every figure, so the lowest is the best. A setting with the figure on fewer runs than another cannot be chosen, as
    it may have failed on hard runs."""
    settings = [{"settings": name} | outcome(comparison, criterion) for name, comparison in comparisons.items()]
    most = max(each["pairs"] for each in settings)
    if most == 0:
        raise Mistake(f"criterion: {criterion}: is measured on no run")
    settings.sort(key=lambda each: (each["pairs"] < most, each["change"] if each["pairs"] else 0.0))
    return {"criterion": criterion, "runs": most, "settings": settings, "best": settings[0]["settings"]}


def tested(choice, held_out, tag):
    """The result of the chosen setting; `held_out` is its comparison on the held-out runs."""
    figure = next(figure for figure in held_out["figures"] if figure["key"] == choice["criterion"])
    return choice | {"figure": figure, "held_out": {"tag": tag} | outcome(held_out, choice["criterion"])}


def verdict(held_out):
    """The verdict by the interval. This is a single test that was chosen before these runs were used, so it needs no
    correction."""
    if held_out["pairs"] < FEWEST_TO_JUDGE:
        return "too few to tell"
    if held_out["low"] > 0:
        return "worse than the baseline"
    return "better than the baseline" if held_out["high"] < 0 else "neither better nor worse than the baseline, as far as they can tell"


def text(table):
    figure, held_out = table["figure"], table["held_out"]
    lines = [f"swept       {len(table['settings'])} settings over {table['runs']} runs, by {figure['label']}; the interval is 95 % of a bootstrap",
             f"best        {table['best']}",
             f"held out    {held_out['pairs']} run{'s' if held_out['pairs'] != 1 else ''} with tag {held_out['tag']}: {verdict(held_out)}",
             *(f"failed      {each['name']}: {each['why']}" for each in held_out["failed"]), ""]
    rows = [(each["settings"], each, table["runs"]) for each in table["settings"]]
    rows.append((f"{table['best']} (held out)", held_out, held_out["pairs"]))
    wide = max(len(name) for name, _, _ in rows)
    lines += [f"{name:<{wide}}  {row_text(figure, each, of)}" for name, each, of in rows]
    return "\n".join(lines) + "\n"


def change_unit(figure):
    """(factor, unit) in which a change is shown."""
    return (100.0, " %") if figure["by_ratio"] else (figure["shown_factor"], f" {figure['unit']}".rstrip())


def row_text(figure, each, of):
    if not each["pairs"]:
        return "not measured"
    factor, unit = change_unit(figure)
    decimals = 1 if figure["by_ratio"] else figure["decimals"]
    after, before = (f"{figure['shown_factor'] * each[key]:.{figure['decimals']}f} {figure['unit']}".rstrip() for key in ("after", "before"))
    change, low, high = ("-" if each[key] is None else f"{factor * each[key]:+.{decimals}f}{unit}" for key in ("change", "low", "high"))
    lacking = "" if each["pairs"] == of else f"  on {each['pairs']} of {of} runs: none to choose"
    return f"{after:>10}  was {before:>10}  {change:>9} [{low}, {high}]{lacking}"     # of one run there is no interval
