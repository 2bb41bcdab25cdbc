"""Measures how well two trajectories agree."""

import bisect
import math


def at(track, time_s):
    """Interpolates (x, y) of the track [(t, x, y, ...)] at `time_s`; None outside of the track."""
    after = bisect.bisect_left(track, (time_s,))
    if after == 0 or after == len(track):
        return None
    (t0, x0, y0), (t1, x1, y1) = track[after - 1][:3], track[after][:3]
    part = (time_s - t0) / (t1 - t0)
    return x0 + part * (x1 - x0), y0 + part * (y1 - y0)


def rms_after_best_fit(track, truth):
    """RMS distance between `track` and `truth` after the best rigid alignment, and the number of compared points."""
    pairs = [((x, y), true) for t, x, y in track if (true := at(truth, t))]
    if len(pairs) < 3:
        return math.inf, len(pairs)
    n = len(pairs)
    ax, ay = (sum(p[0][i] for p in pairs) / n for i in (0, 1))
    bx, by = (sum(p[1][i] for p in pairs) / n for i in (0, 1))
    dot = cross = 0.0
    for (x, y), (u, v) in pairs:
        x, y, u, v = x - ax, y - ay, u - bx, v - by
        dot += x * u + y * v
        cross += x * v - y * u
    angle = math.atan2(cross, dot)
    c, s = math.cos(angle), math.sin(angle)
    total = 0.0
    for (x, y), (u, v) in pairs:
        x, y = x - ax, y - ay
        total += (c * x - s * y + bx - u) ** 2 + (s * x + c * y + by - v) ** 2
    return math.sqrt(total / n), n
