#!/usr/bin/env python3
"""What the intervals of `correct --sensor` hold where the noise of the readings wanders.

Usage: python3 docs/correct_wandering_noise.py FIRST-LAST
Run from the repository's root after `mvn -q -pl simulator -am -DskipTests package`. STILLWATER may hold another way to start
the program. Prints a table with a row for each noise.

For each seed two logs of one sensor, other water and other noise in each. `diagnose` reads the sensor from the first, which
has the truth as its reference; `correct --sensor` undoes it in the second, with the sensor as it was read, and without what of
its noise wanders. The share of rows whose interval holds the water, in the mean and in the worst log, and the errors.

A log: 1800 rows a second apart along a way of 1 m/s, water as a sum of 60 waves about as long as 300 s and some far shorter
(of deviation 1), a time constant of 8 s stepped five times a second, noise of deviation 0.02.
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
ROWS, STEPS, LAG, NOISE, WAVES, BEFORE = 1800, 5, 8.0, 0.02, 60, 100
KINDS = [(0.0, 1.0), (0.8, 4.0), (0.8, 10.0), (0.95, 30.0)]


def log(chance, share, time, path):
    """Writes a log of noise of which `share` wanders over `time` s; returns its truth."""
    waves = []
    for _ in range(WAVES):
        tail = math.sqrt(sum(chance.gauss(0, 1) ** 2 for _ in range(3)) / 3)
        waves.append((abs(chance.gauss(0, 1)) / tail / 50, chance.uniform(0, 2 * math.pi)))
    height = math.sqrt(2 / WAVES)

    def water(at):
        return 8 + height * sum(math.cos(rate * at + phase) for rate, phase in waves)

    shown, wander, fade = water(-BEFORE), chance.gauss(0, 1), math.exp(-1 / time)
    keep = 1 - math.exp(-1 / STEPS / LAG)
    truth, lines = [], ["time_s,x,y,value,truth"]
    for step in range(-BEFORE * STEPS, ROWS * STEPS):
        now = water(step / STEPS)
        shown += keep * (now - shown)
        if step < 0 or step % STEPS:
            continue
        wander = fade * wander + math.sqrt(1 - fade * fade) * chance.gauss(0, 1)
        noise = math.sqrt(share) * wander + math.sqrt(1 - share) * chance.gauss(0, 1)
        row = step // STEPS
        truth.append(now)
        lines.append(f"{row},{row},0,{shown + NOISE * noise:.5f},{now:.5f}")
    path.write_text("\n".join(lines) + "\n")
    return truth


def run(*arguments):
    """Runs the program, and stops where it does not work."""
    done = subprocess.run([*PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)


def score(out, truth):
    """The share of rows that are held, the root mean square of the errors, and the mean half width."""
    with open(out / "corrected.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    ends = [(float(row["corrected_low"]), float(row["corrected_high"])) for row in rows]
    held = sum(low <= u <= high for (low, high), u in zip(ends, truth)) / len(truth)
    error = math.sqrt(sum((float(row["corrected"]) - u) ** 2 for row, u in zip(rows, truth)) / len(truth))
    return held, error, sum(high - low for low, high in ends) / 2 / len(ends)


def seed(number, share, time, work):
    """The scores of one seed: told how the noise wanders, and not."""
    chance = random.Random(f"{number} {share} {time}")
    first, second, sensor = work / "first.csv", work / "second.csv", work / "sensor.json"
    log(chance, share, time, first)
    truth = log(chance, share, time, second)
    run("diagnose", first, "--value", "value", "--reference", "truth", "--numbers-only", "--out", work / "found")
    found = json.loads((work / "found" / "diagnosis.json").read_text())["baseline"]["sensor"]
    scores = []
    for told in (True, False):
        stages = [stage for stage in found["stages"] if told or stage["type"] != "correlated-noise"]
        sensor.write_text(json.dumps({"name": found["name"], "stages": stages}))
        run("correct", second, "--value", "value", "--sensor", sensor, "--quiet", "--out", work / "corrected")
        scores.append(score(work / "corrected", truth))
    return scores


def main():
    """Prints the table."""
    first, last = map(int, sys.argv[1].split("-"))
    print("| share that wanders | over | told: held, worst | error | half width | not told: held, worst | error | half width |")
    print("|---|---|---|---|---|---|---|---|")
    for share, time in KINDS:
        scores = []
        for number in range(first, last + 1):
            with tempfile.TemporaryDirectory() as work:
                scores.append(seed(number, share, time, pathlib.Path(work)))
        cells = []
        for told in range(2):
            held, error, half = ([one[told][k] for one in scores] for k in range(3))
            count = len(scores)
            cells += [f"{sum(held) / count:.3f}, {min(held):.3f}", f"{sum(error) / count:.4f}", f"{sum(half) / count:.4f}"]
        print(f"| {share} | {f'{time:g} s' if share else ''} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
