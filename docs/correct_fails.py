#!/usr/bin/env python3
"""When the intervals of `correct` fail: simulated surveys, corrected with the sensor learned and with it given.

Usage: python3 docs/correct_fails.py slew-limit|two-path [SEED ...]
Run from the repository's root after `mvn -q -pl simulator -am -DskipTests package`. Prints a table; slew-limit also
writes docs/figures/correct-fails.svg. STILLWATER may hold another way to start the program.

A survey: 12 legs of 150 m, 8 m apart, at 1 m/s and 1 Hz, over water of standard deviation 1 that changes over some 25 m;
the sensor is stepped ten times a second; noise of 0.02, last digit 0.01, positions to 0.1 m.
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
FIGURE = pathlib.Path("docs/figures/correct-fails.svg")
LEGS, LEG, APART, SCALE, NOISE, DIGIT, STEPS = 12, 150, 8, 25.0, 0.02, 0.01, 10
RATES = [0.01, 0.02, 0.04, 0.06, 0.08, 0.12, 0.16, 0.32]
SHARES = [0.0, 0.02, 0.05, 0.1, 0.2, 0.4]
FAST, SLOW = 4.0, 60.0
SEEDS = [7301, 7302]


class SlewLimit:
    """Follows at once, but no faster than a rate."""

    def __init__(self, rate, start):
        self.rate, self.shown = rate, start

    def step(self, truth, dt):
        self.shown += max(-self.rate * dt, min(self.rate * dt, truth - self.shown))
        return self.shown


class TwoPath:
    """Most follows soon, and a share only slowly."""

    def __init__(self, share, start):
        self.share, self.fast, self.slow = share, start, start

    def step(self, truth, dt):
        self.fast += (1 - math.exp(-dt / FAST)) * (truth - self.fast)
        self.slow += (1 - math.exp(-dt / SLOW)) * (truth - self.slow)
        return (1 - self.share) * self.fast + self.share * self.slow


def water(chance):
    """A field of standard deviation 1: 60 plane waves."""
    waves = [(chance.gauss(0, 1 / SCALE), chance.gauss(0, 1 / SCALE), chance.uniform(0, 2 * math.pi)) for _ in range(60)]
    root = math.sqrt(2 / len(waves))
    return lambda x, y: root * sum(math.cos(a * x + b * y + p) for a, b, p in waves)


def place(time):
    """Where the boat is: legs there and back, joined by short ways."""
    turn = LEG + APART
    leg, along = min(int(time // turn), LEGS - 1), time % turn
    reached = min(along, LEG)
    x = leg * APART + max(0.0, along - LEG)
    return (x, reached if leg % 2 == 0 else LEG - reached)


def survey(file, sensor, seed):
    """Writes a log with the readings of [sensor], made for its start's truth, and the truth."""
    chance = random.Random(seed)
    field = water(chance)
    probe = sensor(field(*place(0)))
    with open(file, "w", newline="") as out:
        rows = csv.writer(out)
        rows.writerow(["time_s", "x_m", "y_m", "reading", "truth"])
        for second in range(LEGS * (LEG + APART) - APART):
            for step in range(STEPS):
                shown = probe.step(field(*place(second + (step + 1) / STEPS)), 1 / STEPS)
            x, y = place(second + 1)
            read = round((shown + chance.gauss(0, NOISE)) / DIGIT) * DIGIT
            rows.writerow([second + 1, round(x, 1), round(y, 1), f"{read:.2f}", field(x, y)])


def corrected(log, stages, directory):
    """What `correct` makes of [log]: coverage, errors as measured and as corrected, where the sensor came from, which."""
    out = pathlib.Path(directory) / "out"
    command = [*PROGRAM, "correct", str(log), "--value", "reading", "--quiet", "--out", str(out)]
    if stages is not None:
        spec = pathlib.Path(directory) / "sensor.json"
        spec.write_text(json.dumps({"name": "true", "stages": stages}))
        command += ["--sensor", str(spec)]
    subprocess.run(command, check=True)
    with open(out / "corrected.csv", newline="") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    summary = json.loads((out / "summary.json").read_text())
    rms = lambda column: math.sqrt(sum((r[column] - r["truth"]) ** 2 for r in rows) / len(rows))
    return {
        "coverage": sum(r["corrected_low"] <= r["truth"] <= r["corrected_high"] for r in rows) / len(rows),
        "measured": rms("reading"),
        "corrected": rms("corrected"),
        "open": ("rate limit" if summary["sensor_from"] == "rate" else ", ".join(summary["open"]) or summary["sensor_from"])
                + ("; slow path hinted at" if any("hints at a slow path" in it for it in summary["warnings"]) else ""),
    }


def run(values, sensor, stages, seeds):
    """For each of [values] and seeds the sensor learned and given; prints a row each and answers the means."""
    means = []
    for value in values:
        found = []
        for seed in seeds:
            with tempfile.TemporaryDirectory() as directory:
                log = pathlib.Path(directory) / "log.csv"
                survey(log, lambda start: sensor(value, start), seed)
                learned, given = (corrected(log, it, directory) for it in (None, stages(value)))
            print(f"| {value} | {seed} | {learned['measured']:.3f} | {given['corrected']:.3f} | {given['coverage']:.3f} "
                  f"| {learned['corrected']:.3f} | {learned['coverage']:.3f} | {learned['open']} |", flush=True)
            found.append((given, learned))
        means.append((value, *(sum(pair[i]["coverage"] for pair in found) / len(found) for i in (0, 1))))
    return means


def draw(means):
    """Coverage over the rate limit, as SVG."""
    wide, high, left, top, right, low = 640, 380, 70, 50, 30, 60
    ends = [math.log(means[0][0]), math.log(means[-1][0])]
    x = lambda rate: left + (math.log(rate) - ends[0]) / (ends[1] - ends[0]) * (wide - left - right)
    y = lambda share: top + (1 - share) * (high - top - low)
    text = lambda px, py, words, anchor="middle", size=13: (
        f'<text x="{px:.0f}" y="{py:.0f}" text-anchor="{anchor}" font-size="{size}">{words}</text>')
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{high}" font-family="sans-serif" '
             f'fill="#222222"><rect width="{wide}" height="{high}" fill="#FFFFFF"/>',
             text(left, 22, "Rows whose 95 % interval holds the water, by the sensor's rate limit", "start", 16),
             text(left, 40, "water of standard deviation 1 over some 25 m, sailed at 1 m/s; noise 0.02", "start", 12)]
    for share in (0, 0.2, 0.4, 0.6, 0.8, 1):
        parts.append(f'<path d="M{left} {y(share):.1f}H{wide - right}" stroke="#E3E6E8"/>')
        parts.append(text(left - 8, y(share) + 4, f"{share:.1f}", "end"))
    parts.append(f'<path d="M{left} {y(0.95):.1f}H{wide - right}" stroke="#666666" stroke-dasharray="5 4"/>')
    for rate, _, _ in means:
        parts.append(text(x(rate), high - low + 20, f"{rate:g}"))
    parts.append(text((left + wide - right) / 2, high - 14, "Rate limit (1/s)"))
    for column, colour, name in ((1, "#0072B2", "limit given"), (2, "#D55E00", "sensor learned")):
        points = [(x(row[0]), y(row[column])) for row in means]
        way = "L".join(f"{px:.1f} {py:.1f}" for px, py in points)
        parts.append(f'<path d="M{way}" fill="none" stroke="{colour}" stroke-width="2"/>')
        parts += [f'<circle cx="{px:.1f}" cy="{py:.1f}" r="4" fill="{colour}"/>' for px, py in points]
        parts.append(f'<path d="M{wide - 190} {top + 210 + 22 * column}h24" stroke="{colour}" stroke-width="2"/>')
        parts.append(text(wide - 160, top + 214 + 22 * column, name, "start"))
    FIGURE.write_text("\n".join(parts) + "\n</svg>\n")


def main():
    what = sys.argv[1] if len(sys.argv) > 1 else ""
    seeds = [int(seed) for seed in sys.argv[2:]] or SEEDS
    if what not in ("slew-limit", "two-path"):
        sys.exit(__doc__)
    name = "rate limit" if what == "slew-limit" else "slow share"
    print(f"| {name} | seed | rms error measured | given: corrected | holds | learned: corrected | holds | open |")
    print("|---|---|---|---|---|---|---|---|")
    if what == "slew-limit":
        draw(run(RATES, SlewLimit, lambda rate: [{"type": "slew-limit", "rate_per_s": rate}], seeds))
    else:
        run(SHARES, TwoPath, lambda share: [{"type": "two-path-lag", "fast_time_constant_s": FAST,
                                             "slow_time_constant_s": SLOW, "slow_share": share}], seeds)


if __name__ == "__main__":
    main()
