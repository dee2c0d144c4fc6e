#!/usr/bin/env python3
"""What `map --filter self-calibrating` makes of surveys of even cells, by the sensor.

Usage: python3 docs/even_cells.py FIRST[-LAST] [CASE ...]
Run from the repository's root after `mvn -q -pl simulator -am -DskipTests package`. Prints a table with a row a case: the
share of the cells whose 95 % interval holds their water, the mean absolute error, how often the sensor's kind was right,
and of each number of the sensor its mean and in how many logs its interval holds the truth. STILLWATER may hold another
way to start the program.

A survey: ten legs of 90 m east and west and ten north and south through the middles of 10 x 10 cells of 10 m, at 0.7
m/s; each cell's water even, uniform within 7 to 9; sensors stepped a hundred times a row. No range is given.
"""
import csv
import json
import math
import os
import pathlib
import random
import shlex
import subprocess
import sys
import tempfile

PROGRAM = shlex.split(os.environ.get("STILLWATER", "java -jar simulator/target/stillwater.jar"))
SIDE, CELL, SPEED, STEPS = 10, 10.0, 0.7, 100
# Lag, dead time, noise, seconds between rows, jitter of fixes in metres.
CASES = {
    "lag 10 s": (10.0, 0.0, 0.02, 1, 0.0),
    "lag 10 s, fixes off by 0.1 m": (10.0, 0.0, 0.02, 1, 0.1),
    "lag 10 s, fixes off by 0.4 m": (10.0, 0.0, 0.05, 1, 0.4),
    "lag 30 s, noise 0.05": (30.0, 0.0, 0.05, 1, 0.0),
    "lag 30 s, noise 0.01": (30.0, 0.0, 0.01, 1, 0.0),
    "lag 60 s": (60.0, 0.0, 0.02, 1, 0.0),
    "dead time 3 s, lag 10 s": (10.0, 3.0, 0.02, 1, 0.0),
    "dead time 3 s, lag 10 s, a row in 2 s": (10.0, 3.0, 0.02, 2, 0.0),
}


def survey(file, truths, chance, lag, dead, noise, step, jitter):
    """Writes the log."""
    middles = [CELL * (k + 0.5) for k in range(SIDE)]
    ends = [(middles[0], middles[-1]), (middles[-1], middles[0])]
    corners = [(x, middles[k]) for k in range(SIDE) for x in ends[k % 2]]
    corners += [(middles[k], y) for k in range(SIDE) for y in ends[1 - k % 2]]
    part, late, seen, shown = step / STEPS, round(dead * STEPS / step), [], None
    here, (x, y), count = 1, corners[0], 0
    file.write("time_s,x_m,y_m,value\n")
    while here < len(corners):
        seen.append(truths[int(y / CELL)][int(x / CELL)])
        water = seen[max(0, len(seen) - 1 - late)]
        shown = water if shown is None else shown + (water - shown) * -math.expm1(-part / lag)
        if count % STEPS == 0:
            file.write("%.3f,%.4f,%.4f,%.6f\n" % (count * part, x + chance.gauss(0, jitter), y + chance.gauss(0, jitter),
                                                  shown + chance.gauss(0, noise)))
        count += 1
        way = math.dist((x, y), corners[here])
        share = min(1.0, SPEED * part / way) if way > 0 else 1.0
        x, y = x + share * (corners[here][0] - x), y + share * (corners[here][1] - y)
        here += share == 1.0


def mapped(seed, case):
    """What the program makes of one log: share held, error, the sensor chosen and its numbers."""
    chance = random.Random(seed)
    truths = [[chance.uniform(7, 9) for _ in range(SIDE)] for _ in range(SIDE)]
    with tempfile.TemporaryDirectory() as directory:
        log, out = pathlib.Path(directory, "log.csv"), pathlib.Path(directory, "out")
        with log.open("w") as file:
            survey(file, truths, chance, *case)
        said = subprocess.run([*PROGRAM, "map", str(log), "--value", "value", "--filter", "self-calibrating", "--cell",
                               "10", "--out", str(out), "--json"], check=True, capture_output=True, text=True).stdout
        held = errors = count = 0
        for row in csv.DictReader((out / "cells.csv").open()):
            column, line = int(float(row["x_m"]) / CELL), int(float(row["y_m"]) / CELL)
            inside = 0 <= column < SIDE and 0 <= line < SIDE
            if not inside or int(row["visits"]) == 0 or not row["value"]:
                continue
            count += 1
            errors += abs(float(row["value"]) - truths[line][column])
            held += float(row["lower"] or "-inf") <= truths[line][column] <= float(row["upper"] or "inf")
    models = json.loads(said)["sensor"]["models"]
    kind = next(name for name, model in models.items() if model["standing"] == "chosen")
    return held / count, errors / count, kind, models[kind]


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def row(name, case, found):
    truth = {"time_constant_s": case[0], "dead_time_s": case[1]}
    right = "dead-time" if case[1] > 0 else "first-order-lag"
    numbers = []
    for key, value in truth.items():
        told = [model[key] for _, _, _, model in found if key in model]
        if told:
            holds = sum(one["low"] <= value <= one["high"] for one in told)
            numbers.append("%s %.2f, %d of %d" % (key[:-2].replace("_", " "), mean(one["value"] for one in told), holds, len(told)))
    return "| %s | %.2f | %.4f | %d of %d | %s |" % (
        name, mean(one[0] for one in found), mean(one[1] for one in found), sum(one[2] == right for one in found),
        len(found), "; ".join(numbers))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    first, _, last = sys.argv[1].partition("-")
    seeds = range(int(first), int(last or first) + 1)
    print("| sensor | cells held | mean error | kind right | numbers: mean, intervals that hold |\n|---|---|---|---|---|")
    for name in sys.argv[2:] or CASES:
        print(row(name, CASES[name], [mapped(seed, CASES[name]) for seed in seeds]), flush=True)


if __name__ == "__main__":
    main()
