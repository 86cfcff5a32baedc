#!/usr/bin/python3
"""Draws what scenario_bench measured: times to the first plan, and arrivals.

usage: draw_plans.py LOGS PICTURES

Reads OMPL's logs, <scenario>-<planner>.log in the folder LOGS, and writes plans_first.svg and
plans_arrival.svg into the folder PICTURES: per scenario and planner the median of all runs with an
interval that holds it with a probability of 0.99, as scenario_bench prints it. (Debian's own
interpreter, since matplotlib is its package.)
"""
import math
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # after the choice of a canvas that needs no display

# Planner as OMPL names it: name, colour, marker. From above in each row.
PLANNERS = {
    "SafeInterval": ("SafeIntervalPlanner", "#0072b2", "o"),
    "RRT": ("RRT", "#e69f00", "s"),
    "RRTConnect": ("RRTConnect", "#cc3311", "D"),
    "RRTstar": ("RRT*", "#666666", "^"),
}
OUTSIDE = 0.01  # the probability that a median is not in its interval


def read_log(path):
    """The experiment's name, the seconds of a run, and the runs as dicts of texts."""
    text = path.read_text(encoding="utf-8", errors="replace")
    experiment = re.search(r"^Experiment (.*)$", text, re.MULTILINE).group(1)
    budget_s = float(re.search(r"^(\S+) seconds per run$", text, re.MULTILINE).group(1))
    lines = iter(text[re.search(r"^\d+ properties for each run$", text, re.MULTILINE).start():]
                 .splitlines())
    names = [next(lines).rsplit(" ", 1)[0] for _ in range(int(next(lines).split()[0]))]
    count = int(next(lines).split()[0])
    rows = [[field.strip() for field in next(lines).split(";")] for _ in range(count)]
    return experiment, budget_s, [dict(zip(names, row)) for row in rows]


def median_of(values):
    """The median and its interval by order statistics, as MedianOf in planner_runs.cc."""
    values, n, below, low = sorted(values), len(values), 0.0, 0
    for i in range(n):
        below += math.comb(n, i) / 2**n
        if 2 * below > OUTSIDE:
            break
        low = i
    return (values[(n - 1) // 2] + values[n // 2]) / 2, values[low], values[n - 1 - low]


def read_all(folder):
    """{scenario: {planner: {"first": .., "arrival": .., "solved": .., "runs": ..}}}"""
    scenarios = {}
    for path in sorted(folder.glob("*.log")):
        planner = path.stem.rsplit("-", 1)[-1]
        if planner not in PLANNERS:
            continue
        name, budget_s, runs = read_log(path)
        first = [float(run.get("time to first solution") or budget_s) for run in runs]
        arrivals = [float(run["arrival"]) for run in runs if run.get("arrival")]
        scenarios.setdefault(name, {})[planner] = {
            "first": median_of(first),
            "arrival": median_of(arrivals) if arrivals else None,
            "solved": len(arrivals),
            "runs": len(runs),
        }
    ours = lambda item: item[1].get("SafeInterval", {"first": (math.inf,)})["first"][0]
    return dict(sorted(scenarios.items(), key=ours))


def draw_header(axes):
    """The planners' names in their colours, over the picture."""
    for place, (name, colour, marker) in zip((0.0, 0.33, 0.52, 0.76), PLANNERS.values()):
        axes.plot(place + 0.01, 1.03, marker, color=colour, ms=6, transform=axes.transAxes,
                  clip_on=False)
        axes.text(place + 0.03, 1.03, name, color=colour, va="center", transform=axes.transAxes)


def draw_one(axes, y, planner, result, what):
    """A planner's median, its interval, and how many runs it solved if not all."""
    _, colour, marker = PLANNERS[planner]
    missed = result["solved"] < result["runs"]
    if result[what]:
        median, low, high = result[what]
        axes.plot([low, high], [y, y], color=colour, lw=2, solid_capstyle="butt")
        axes.plot(median, y, marker, color=colour, ms=6)
    if missed:
        place = result[what][2] if result[what] else axes.get_xlim()[1]
        note = f"{result['solved']} of {result['runs']}" if result["solved"] else "none"
        axes.annotate(note, (place, y), (6, 0), textcoords="offset points", va="center",
                      color=colour, fontsize=7)


def limits_of(scenarios, what):
    """From a little before all intervals to a little after."""
    ends = [end for results in scenarios.values() for result in results.values() if result[what]
            for end in result[what][1:]]
    return 0.8 * min(ends), 1.25 * max(ends)


def draw(scenarios, what, label, subdivisions, path):
    """One picture, a row for each scenario; lines at these multiples of powers of ten."""
    figure, axes = pyplot.subplots(figsize=(8, 0.9 + 0.62 * len(scenarios)))
    axes.set_xscale("log")
    axes.set_xlim(limits_of(scenarios, what))
    for row, (name, results) in enumerate(scenarios.items()):
        if row % 2:
            axes.axhspan(row - 0.5, row + 0.5, color="#f4f4f4", lw=0)
        for place, planner in enumerate(PLANNERS):
            if planner in results:
                draw_one(axes, row - 0.3 + 0.2 * place, planner, results[planner], what)
    axes.set_ylim(len(scenarios) - 0.5, -0.5)
    axes.set_yticks(range(len(scenarios)), list(scenarios))
    axes.tick_params(axis="y", length=0)
    axes.xaxis.set_major_locator(ticker.LogLocator(subs=subdivisions))
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:g}")
    axes.xaxis.set_minor_formatter("")
    axes.grid(axis="x", color="#dddddd", lw=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
    axes.set_xlabel(label)
    draw_header(axes)
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None})
    pyplot.close(figure)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    logs, pictures = Path(sys.argv[1]), Path(sys.argv[2])
    matplotlib.rcParams.update({"svg.hashsalt": "clearway", "svg.fonttype": "none",
                                "font.family": "sans-serif", "font.size": 9})
    scenarios = read_all(logs)
    if not scenarios:
        sys.exit(f"{logs}: no logs of scenario_bench")
    pictures.mkdir(parents=True, exist_ok=True)
    draw(scenarios, "first", "seconds to the first plan (1: none within the second)", (1,),
         pictures / "plans_first.svg")
    draw(scenarios, "arrival", "arrival of the best plan after a second, seconds (solved runs)",
         (1, 2, 5), pictures / "plans_arrival.svg")


main()
