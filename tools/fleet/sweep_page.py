"""Makes the page of a sweep: for each key a plot of the criterion against its values with the chosen setting, and the
table."""

import html
import math

import sweep_table

WIDE, HIGH, LEFT, BELOW, ABOVE, RIGHT = 640, 260, 64, 34, 14, 20      # pixels
LOG_FROM = 30     # a key whose values span at least this factor has a logarithmic axis

PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>Sweep: {best}</title>
<style>
  :root {{ color-scheme: light dark; --ink: light-dark(#222, #ddd); --quiet: light-dark(#8888, #8888); --mark: light-dark(#06c, #6bf);
    --held: light-dark(#c50, #fa5) }}
  body {{ font: 15px/1.4 system-ui, sans-serif; margin: 1.5em auto; max-width: 60em; padding: 0 1em; color: var(--ink) }}
  pre {{ overflow-x: auto; font-size: 13px }}
  svg {{ width: 100%; max-width: {wide}px; display: block; font-size: 12px }}
  svg text {{ fill: var(--ink) }}
  .axis {{ stroke: var(--quiet) }} .bar {{ stroke: var(--ink); opacity: .5 }} .dot {{ fill: var(--ink) }}
  .out .dot {{ fill: none; stroke: var(--ink) }} .best .dot {{ fill: var(--mark) }} .best .bar {{ stroke: var(--mark); opacity: 1; stroke-width: 2 }}
  .held .dot {{ fill: var(--held) }} .held .bar {{ stroke: var(--held); opacity: 1; stroke-width: 2 }}
</style>
<h1>Sweep</h1>
<p>Change of {label} against the baseline: lower is better. Bars are 95 % of a bootstrap over the runs. Blue: the best;
orange: the best over the runs that were held out; a ring: has the figure on fewer runs than others, so none to choose.</p>
{plots}
<pre>{text}</pre>
</html>
"""


def page(table):
    keys = [assignment.partition("=")[0] for assignment in table["settings"][0]["set"]]
    plots = "\n".join(plot(table, index, key) for index, key in enumerate(keys))
    return PAGE.format(best=html.escape(table["best"]), label=html.escape(table["figure"]["label"]), wide=WIDE, plots=plots,
                       text=html.escape(sweep_table.text(table)))


def points_of(table, index):
    """Lists (value, row, class) of the measured points. The held-out one comes last, so that it is drawn on top."""
    best = next(each for each in table["settings"] if each["settings"] == table["best"])
    rows = [(each, "best" if each is best else "out" if each["pairs"] < table["runs"] else "") for each in table["settings"]]
    rows.append((table["held_out"] | {"set": best["set"], "settings": f"{table['best']} (held out)"}, "held"))
    return [(each["set"][index].partition("=")[2], each, kind) for each, kind in rows if each["pairs"]]


def plot(table, index, key):
    points = points_of(table, index)
    x_of, x_ticks = horizontal([value for value, _, _ in points])
    y_of, y_ticks = vertical([each[bound] for _, each, _ in points for bound in ("change", "low", "high") if each[bound] is not None] + [0.0])
    factor, unit = sweep_table.change_unit(table["figure"])
    marks = [f'<line class="axis" x1="{LEFT}" x2="{WIDE - RIGHT}" y1="{y_of(y):.1f}" y2="{y_of(y):.1f}"/>'
             f'<text x="{LEFT - 6}" y="{y_of(y) + 4:.1f}" text-anchor="end">{factor * y:+.3g}{unit}</text>' for y in y_ticks]
    marks += [f'<text x="{x:.1f}" y="{HIGH - BELOW + 16}" text-anchor="middle">{html.escape(label)}</text>' for x, label in x_ticks]
    marks += [mark(x_of(value), y_of, each, kind) for value, each, kind in points]
    return (f'<h2>{html.escape(key)}</h2>\n<svg viewBox="0 0 {WIDE} {HIGH}" role="img" aria-label="{html.escape(key)}">'
            + "".join(marks) + "</svg>")


def mark(x, y_of, each, kind):
    bar = ""
    if each["low"] is not None:     # one run has no interval
        bar = f'<line class="bar" x1="{x:.1f}" x2="{x:.1f}" y1="{y_of(each["low"]):.1f}" y2="{y_of(each["high"]):.1f}"/>'
    return (f'<g class="{kind}"><title>{html.escape(each["settings"])}</title>{bar}'
            f'<circle class="dot" cx="{x:.1f}" cy="{y_of(each["change"]):.1f}" r="4"/></g>')


def horizontal(values):
    """Returns the position of a value and the (position, label) of the ticks. Other values than numbers get equal
    distances."""
    span = WIDE - LEFT - RIGHT - 40
    try:
        numbers = sorted({float(value) for value in values})
    except ValueError:
        names = list(dict.fromkeys(values))
        places = {name: LEFT + 20 + span * (at + 0.5) / len(names) for at, name in enumerate(names)}
        return places.get, [(place, name) for name, place in places.items()]
    scale = math.log if numbers[0] > 0 and numbers[-1] / numbers[0] >= LOG_FROM else float
    low, high = scale(numbers[0]), scale(numbers[-1])

    def place(value):
        return LEFT + 20 + (span * (scale(float(value)) - low) / (high - low) if high > low else span / 2)
    shown = numbers if len(numbers) <= 6 else [numbers[round(part * (len(numbers) - 1) / 5)] for part in range(6)]
    ticks = []
    for number in shown:     # leaves out ticks that would overlap
        if not ticks or place(number) - ticks[-1][0] > 48:
            ticks.append((place(number), f"{number:.4g}"))
    return place, ticks


def vertical(values):
    low, high = min(values), max(values)
    margin = 0.05 * (high - low) or 0.01
    low, high = low - margin, high + margin
    step = 10.0 ** math.floor(math.log10(high - low))
    step = next(step * part for part in (0.1, 0.2, 0.5, 1.0, 2.0) if (high - low) / (step * part) <= 6)
    ticks = [step * count for count in range(math.ceil(low / step), math.floor(high / step) + 1)]
    return lambda value: HIGH - BELOW - (HIGH - BELOW - ABOVE) * (value - low) / (high - low), ticks
