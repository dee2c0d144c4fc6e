#!/usr/bin/env python3
"""Runs every row of the bars for estimators and planners on one seed and prints a Markdown table of what held.

Usage: python3 docs/bars.py --seed SEED [--only PART[,PART ...]] [--program COMMAND] [--environments N]
Run from the repository's root after `mvn -q -pl simulator -am -DskipTests package`; COMMAND (or STILLWATER) is another way
to start the program. Parts: unknown, bounded, sensors, slew, prior, intervals, settled, boats, logs; all of them without
--only. Each command is run once and told on standard error. logs needs STILLWATER_DATA, the directory with
lac_hertel_asv and gordon2020_float, and is said to be skipped without it. Numbers are of 100 environments unless
told otherwise, "uniform / Gaussian" field. Ends with status 1 if a bar is missed.
"""
import argparse
import csv
import json
import os
import pathlib
import shlex
import statistics
import subprocess
import sys
import tempfile

FIELDS = ("uniform", "gaussian")
MOVES = (50, 100, 200, 500, 1000, 2000)
HELD = MOVES[1:]
SENSORS = {
    "first-order lag": None,
    "asymmetric, 0.13 and 0.07 a reading": "asymmetric",
    "asymmetric, lags of 1.3 and 0.7": "asymmetric-slow-rise",
    "dead time": "dead-time",
    "second order": "second-order",
    "slew limit": "slew-limit",
}
# A belief about the time constant that is three times too short, and too long.
WRONG = {"too short": ("--time-constant", "3.16"), "too long": ("--time-constant", "28.5")}
COVERED = (0.93, 0.97)
# The move to the start's neighbour: no planner knows more of one than of the other.
BLIND = 2


class Bars:
    def __init__(self, program, seed, environments):
        self.program, self.seed, self.environments, self.found = program, seed, environments, {}
        self.missed = 0

    def run(self, *arguments, preset="noisy", moves=MOVES):
        """Rows of results.csv and bounds.csv by field, filter, planner, move and boats."""
        words = ["benchmark", "--preset", preset, "--seed", self.seed, "--checkpoints", ",".join(map(str, moves))]
        words += ([] if "--environments" in arguments else ["--environments", self.environments]) + list(arguments)
        if tuple(words) not in self.found:
            print(" ".join(words), file=sys.stderr, flush=True)
            with tempfile.TemporaryDirectory() as out:
                subprocess.run([*self.program, *words, "--quiet", "--out", out], check=True)
                rows = {}
                for name in ("results.csv", "bounds.csv"):
                    with open(pathlib.Path(out) / name, newline="") as file:
                        for row in csv.DictReader(file):
                            key = (row["field"], row["filter"], row["planner"], int(row["move"]), int(row["boats"]))
                            rows.setdefault(key, {}).update(row)
            self.found[tuple(words)] = rows
        return self.found[tuple(words)]

    def row(self, what, bar, found, holds):
        """A row of the table; [holds] is None where nothing was run."""
        self.missed += holds is False
        said = {True: "held", False: "**missed**", None: "skipped"}[holds]
        print(f"| {what} | {bar} | {found} | {said} |", flush=True)


def at(rows, move, kind="self-calibrating", planner="lawnmower", column="mean_abs_error", boats=1):
    """One number of each field."""
    return [float(rows[field, kind, planner, move, boats][column]) for field in FIELDS]


def pair(numbers):
    return " / ".join(f"{it:.3g}" for it in numbers)


def lawnmower(bars, sensor=None, belief=()):
    """The self-calibrating estimator behind the lawnmower: most bars are of it."""
    spec = [] if sensor is None else ["--sensor", f"docs/sensors/noisy-{sensor}.json"]
    return bars.run("--planner", "lawnmower", "--filter", "self-calibrating", *spec, *belief)


def information(bars, belief=()):
    moves = (50, 100)
    return bars.run("--planner", "information", "--filter", "bayesian", *belief, "--moves", "100", moves=moves)


def without_lag(bars):
    spec = "docs/sensors/noisy-without-lag.json"
    return bars.run("--planner", "lawnmower", "--filter", "averaging", "--sensor", spec)


def settling(bars, preset, belief=()):
    """The slew limit where the boat waits for it: of the noisy preset with its sensor, and the original's."""
    words = ["--planner", "settling-lawnmower", "--filter", "self-calibrating", *belief]
    if preset == "noisy":
        words += ["--sensor", "docs/sensors/noisy-slew-limit.json"]
    else:
        words += ["--pattern", "hamiltonian-cycle"]
    return bars.run(*words, preset=preset, moves=(100, 200, 500))


def unknown(bars):
    rows = lawnmower(bars)
    found = at(rows, 100)[0]
    bars.row("time constant unknown, uniform field, 100 moves", "0.0030", f"{found:.3g}", found <= 0.0030)
    oracle = at(without_lag(bars), 2000, "averaging")
    ratios = [own / best for own, best in zip(at(rows, 2000), oracle)]
    bars.row("time constant unknown, over a sensor without lag, 2000 moves", "3", pair(ratios), max(ratios) <= 3)
    for move, bar in ((50, 0.022), (100, 0.0022)):
        found = at(information(bars), move, "bayesian", "information")[1]
        bars.row(f"time constant unknown, Gaussian field, {move} moves (bayesian, information)", bar, f"{found:.3g}",
                 found <= bar)


def bounded(bars):
    own = ("bounded-extended", "bounded-extended")
    rows = bars.run("--filter", "bounded,averaging", "--planner", "random-walk,lawnmower,bounded")
    dense = [*range(1, 21), *range(25, 101, 5), *range(120, 401, 20), *range(500, 2001, 100)]
    extended = bars.run("--filter", own[0], "--planner", f"random-walk,{own[1]}", moves=dense)
    for place, (field, bar) in enumerate(zip(FIELDS, (1.5, 3))):
        for move in (200, 500, 1000, 2000):
            best = min(at(rows, move, kind, planner)[place] for kind in ("bounded", "averaging")
                       for planner in ("random-walk", "lawnmower", "bounded"))
            ratio = best / at(extended, move, *own)[place]
            bars.row(f"bounded-extended below the best of the report's six, {'uniform' if field == 'uniform' else 'Gaussian'} field, {move} moves", f"{bar} times",
                     f"{ratio:.3g} times", ratio >= bar)
    differences = {move: max(planned - walked for planned, walked in zip(
        at(extended, move, *own), at(extended, move, own[0], "random-walk"))) for move in dense}
    later = [differences[move] for move in dense if move > BLIND]
    # Until then either has gone into a cell of which nothing is known: which is the better one is chance.
    error = max(at(extended, BLIND, *own, column="standard_error"))
    bars.row(f"planner of bounded-extended not above the random walk at any of {len(later)} checkpoints after move {BLIND}", "0",
             f"below at all, by {-max(later):.2g} at the least; {differences[BLIND]:+.2g} at move {BLIND}, "
             f"where nothing is known to choose by (standard error {error:.2g})", max(later) <= 0)

def kinds(bars):
    """Of each bar of a sensor that is not told: what it is, at which move, its bar, its sensor."""
    for name in list(SENSORS)[1:4]:
        yield name, 100, 0.006, SENSORS[name]
    yield "second order", 200, 0.010, "second-order"


def sensors(bars):
    for name, move, bar, sensor in kinds(bars):
        found = at(lawnmower(bars, sensor), move)
        bars.row(f"{name}, kind not told, {move} moves", bar, pair(found), max(found) <= bar)


def slew(bars):
    for preset, name in (("original", "slew limit of the original experiment"), ("noisy", "slew limit of 0.01 a reading, noisy")):
        found = at(settling(bars, preset), 500, planner="settling-lawnmower")
        bars.row(f"{name}, kind not told, settling lawnmower, 500 moves", "0.005", pair(found), max(found) <= 0.005)


def prior(bars):
    """By how much each bar above is worse with a belief that is three times off."""
    for name, words in WRONG.items():
        belief = (*words, "--factor", "3")
        cases = [("first-order lag, 100 moves", at(lawnmower(bars, belief=belief), 100), at(lawnmower(bars), 100)),
                 ("first-order lag, 2000 moves", at(lawnmower(bars, belief=belief), 2000), at(lawnmower(bars), 2000))]
        cases += [(f"bayesian, information, Gaussian, {move} moves", *(
            [at(information(bars, it), move, "bayesian", "information")[1]] for it in (belief, ()))) for move in (50, 100)]
        cases += [(f"{kind}, {move} moves", at(lawnmower(bars, sensor, belief), move), at(lawnmower(bars, sensor), move))
                  for kind, move, _, sensor in kinds(bars)]
        cases += [(f"slew limit, {preset}, 500 moves", *(
            at(settling(bars, preset, it), 500, planner="settling-lawnmower") for it in (belief, ())))
                  for preset in ("original", "noisy")]
        for what, wrong, told in cases:
            losses = [100 * (a / b - 1) for a, b in zip(wrong, told)]
            bars.row(f"belief 3 times {name}: {what}", "10 % worse", " / ".join(f"{it:+.1f} %" for it in losses),
                     max(losses) <= 10)


def intervals(bars):
    for name, sensor in SENSORS.items():
        covered(bars, f"95 % intervals, {name}", lawnmower(bars, sensor), HELD)
    # Without noise nothing is left to chance but what rounding of numbers does: intervals may hold all.
    for preset, bar in (("noisy", COVERED), ("original", (0.93, 1.0))):
        covered(bars, f"95 % intervals, slew limit, settling lawnmower, {preset}", settling(bars, preset),
                (100, 200, 500), planner="settling-lawnmower", bar=bar)
    covered(bars, "95 % intervals of bayesian, lawnmower", bars.run("--planner", "lawnmower", "--filter", "bayesian"), HELD,
            kind="bayesian")
    for name in list(SENSORS)[:3]:
        spec = [] if SENSORS[name] is None else ["--sensor", f"docs/sensors/noisy-{SENSORS[name]}.json"]
        rows = bars.run("--planner", "lawnmower", "--filter", "interval", *spec)
        covered(bars, f"bounds of interval, {name}", rows, HELD, kind="interval", bar=(0.95, 1.0))


def covered(bars, what, rows, moves, kind="self-calibrating", planner="lawnmower", bar=COVERED):
    """What intervals hold after each of some moves."""
    found = [at(rows, move, kind, planner, "coverage") for move in moves]
    cells = []
    for place in range(len(FIELDS)):
        cells.append(" ".join(f"{it[place]:.3f}" if bar[0] <= it[place] <= bar[1] else f"**{it[place]:.3f}**" for it in found))
    limits = f"{bar[0]} to {bar[1]}" if bar[1] < 1 else f"{bar[0]} or more"
    bars.row(f"{what}, {', '.join(map(str, moves))} moves", limits, " / ".join(cells),
             all(bar[0] <= it <= bar[1] for pairs in found for it in pairs))


def settled(bars):
    found = at(lawnmower(bars), 100)
    bars.row("accuracy of stop-and-wait, 100 moves (it needs 240 to 345)", "0.007", pair(found), max(found) <= 0.007)


def boats(bars):
    """Four boats at 115 moves each against one at 400, uniform field: each filter with the planner that is made for it."""
    for planner, kind in (("lawnmower", "self-calibrating"), ("bounded-extended", "bounded-extended")):
        rows = bars.run("--field", "uniform", "--planner", planner, "--filter", kind, "--boats", "1,4", moves=(115, 400))
        one, four = (float(rows["uniform", kind, planner, move, n]["mean_abs_error"]) for move, n in ((400, 1), (115, 4)))
        bars.row(f"4 boats after 115 moves each over 1 boat after 400, uniform, {planner}, {kind}", "1", f"{four / one:.3g}",
                 four <= one)


def corrected(bars, *arguments):
    print(" ".join(("correct", *arguments)), file=sys.stderr, flush=True)
    with tempfile.TemporaryDirectory() as out:
        subprocess.run([*bars.program, "correct", *arguments, "--quiet", "--out", out], check=True)
        return json.loads((pathlib.Path(out) / "summary.json").read_text())


def logs(bars):
    hertel = "Lac Hertel, opposite legs of dissolved oxygen, learned on some legs, scored on others"
    gordon = "Gordon's float, up against down, root mean square over 20 to 180 dbar, casts not learned on"
    data = os.environ.get("STILLWATER_DATA")
    if not data:
        for what, bar in ((hertel, "-46 %"), (gordon, "4.0 umol")):
            bars.row(what, bar, "STILLWATER_DATA is not set", None)
        return
    found = corrected(bars, f"{data}/lac_hertel_asv/survey.csv", "--value", "odo_percent_sat", "--held-out")["held_out"]
    gains = [100 * (it["opposite_legs_after"] / it["opposite_legs_before"] - 1) for it in found]
    bars.row(hertel, "-46 %", f"{statistics.mean(gains):.1f} % ({', '.join(f'{it:.0f}' for it in gains)})",
             statistics.mean(gains) <= -46)
    found = corrected(bars, f"{data}/gordon2020_float/profiles.csv", "--x", "pres_dbar", "--value", "doxy_umol", "--held-out",
                      "--between", "20:180")["held_out"]
    before, after = ([it[name] for it in found] for name in ("passes_rms_before", "passes_rms_after"))
    bars.row(gordon, "4.0 umol", f"{statistics.mean(before):.1f} to {statistics.mean(after):.2f} umol "
             f"({', '.join(f'{it:.2f}' for it in after)})", statistics.mean(after) <= 4.0)


PARTS = {part.__name__: part for part in (unknown, bounded, sensors, slew, prior, intervals, settled, boats, logs)}


def drive(parts, usage, head=()):
    """Runs the parts that the command line asks for, below the lines of a table's head."""
    parser = argparse.ArgumentParser(description=usage, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", required=True)
    parser.add_argument("--only", default=",".join(parts))
    parser.add_argument("--program", default=os.environ.get("STILLWATER", "java -jar simulator/target/stillwater.jar"))
    parser.add_argument("--environments", default="100")
    given = parser.parse_args()
    wanted = given.only.split(",")
    unheard = [name for name in wanted if name not in parts]
    if unheard:
        parser.error(f"expected some of {', '.join(parts)}, found {', '.join(unheard)}")
    bars = Bars(shlex.split(given.program), given.seed, given.environments)
    for line in head:
        print(line, flush=True)
    for name in wanted:
        parts[name](bars)
    return bars


def main():
    missed = drive(PARTS, __doc__, ("| what | bar | found, uniform / Gaussian | |", "|---|---|---|---|")).missed
    print(f"\n{missed} missed.", file=sys.stderr)
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
