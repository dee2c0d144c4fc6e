#!/usr/bin/env python3
"""What the intervals of `correct` hold on lawnmower surveys that nowhere cross, by the sensor.

Usage: python3 docs/correct_sensors.py FIRST[-LAST] [SENSOR ...] [--reference NOISE] [--given] [--hertz N]
Run from the repository's root after `mvn -q -pl simulator -am -DskipTests package`. Prints a table with a row a sensor
and a number a seed: the share of rows whose interval holds the water. STILLWATER may hold another way to start the
program. With --reference the log has a column of the water with noise of that deviation, and the sensor is learned from it.
With --given the sensor is given, where the spec language has it; with --hertz there are so many readings a second, of 1, 2, 5
and 10.

A survey: 14 legs of 150 m, 8 m apart, 1 Hz, at 0.5 to 1.2 m/s, helm within some 0.4 m; water of standard deviation 0.85
over some 25 m and 0.25 over a third of that, and a front of 1.6; sensors stepped ten times a second; noise 0.02, last
digit 0.01; fixes off by 0.5 m that lasts for a minute and 0.15 m from row to row.
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
STEPS, NOISE, DIGIT, LEGS, LEG, APART, SCALE, WAVES = 10, 0.02, 0.01, 14, 150.0, 8.0, 25.0, 40


def water(chance):
    """A field of two lengths and a front."""
    waves = [(chance.gauss(0, part / SCALE), chance.gauss(0, part / SCALE), chance.uniform(0, 2 * math.pi), size)
             for part, size in ((1, 0.85), (3, 0.25)) for _ in range(WAVES)]
    root = math.sqrt(2 / WAVES)
    angle, off, wide = chance.uniform(0, 2 * math.pi), chance.gauss(0, 30), chance.uniform(4, 10)

    def at(x, y):
        across = (x - 50) * math.cos(angle) + (y - 75) * math.sin(angle) - off
        return root * sum(s * math.cos(a * x + b * y + p) for a, b, p, s in waves) + 0.8 * math.tanh(across / wide)
    return at


def track(chance):
    """Where the boat is and how fast, ten times a second."""
    ends = [(leg * APART, y) for leg in range(LEGS) for y in ((0.0, LEG) if leg % 2 == 0 else (LEG, 0.0))]
    swings = [(chance.uniform(0, 2 * math.pi), chance.uniform(60, 400)) for _ in range(3)]
    helm = [(chance.gauss(0, 0.4), chance.gauss(0, 0.4)) for _ in range(400)]
    found, part, along = [], 0, 0.0
    while True:
        time = len(found) / STEPS
        speed = 0.85 + 0.35 * sum(math.sin(2 * math.pi * time / length + phase) for phase, length in swings) / 3
        along += speed / STEPS
        while part < len(ends) - 1 and along > math.dist(ends[part], ends[part + 1]):
            along -= math.dist(ends[part], ends[part + 1])
            part += 1
        if part == len(ends) - 1:
            return found
        share, knot = along / math.dist(ends[part], ends[part + 1]), len(found) / 200
        near = knot - int(knot)
        found.append(tuple(ends[part][k] + share * (ends[part + 1][k] - ends[part][k])
                           + (1 - near) * helm[int(knot)][k] + near * helm[int(knot) + 1][k] for k in (0, 1)) + (speed,))


def lag(inputs, times, rising=None):
    """A lag of [times], one number or one each step; of [rising] where the input is above."""
    shown, out = inputs[0], []
    for i, wanted in enumerate(inputs):
        time = rising if rising and wanted > shown else times[i] if isinstance(times, list) else times
        shown += (1 - math.exp(-1 / STEPS / time)) * (wanted - shown)
        out.append(shown)
    return out


def limited(inputs, rate):
    """No faster than [rate]."""
    shown, out = inputs[0], []
    for wanted in inputs:
        shown += max(-rate / STEPS, min(rate / STEPS, wanted - shown))
        out.append(shown)
    return out


def late(inputs, seconds):
    """A dead time."""
    return [inputs[0]] * (seconds * STEPS) + inputs[:-seconds * STEPS]


def flow(places):
    """8 s at 1.15 m/s, five times as much more at half of that."""
    return [8 * (1 + 5 * max(0.0, min(1.0, (1.15 - speed) / 0.6)) ** 1.5) for _, _, speed in places]


def power(places):
    """12 s at 0.85 m/s, and by the power -1 of the speed, as the spec language has it."""
    return [12 * 0.85 / max(speed, 0.01) for _, _, speed in places]


def warmth(places):
    """7 s at 16 degrees, 7 % less a degree, in water of 8 to 18."""
    return [7 * math.exp(0.07 * (4 - 4 * math.tanh((y - 70) / 30) - 2 * math.sin(x / 40))) for x, y, _ in places]


def wandering(inputs, chance):
    """A lag whose zero goes for a random walk, 0.4 in 40 minutes."""
    off, out = 0.0, []
    for shown in lag(inputs, 6.0):
        off += chance.gauss(0, 0.008 / math.sqrt(STEPS))
        out.append(shown + off)
    return out


SENSORS = {
    "none": lambda u, p, c: u,
    "lag": lambda u, p, c: lag(u, 6.0),
    "dead-time": lambda u, p, c: late(u, 5),
    "two-lags": lambda u, p, c: lag(lag(u, 4.0), 4.0),
    "asymmetric": lambda u, p, c: lag(u, 4.0, 9.0),
    "two-path": lambda u, p, c: [0.9 * a + 0.1 * b for a, b in zip(lag(u, 4.0), lag(u, 60.0))],
    "lag, wild readings": lambda u, p, c: lag(u, 6.0),
    "lag, then rate limit": lambda u, p, c: limited(lag(u, 4.0), 0.06),
    "rate limit": lambda u, p, c: limited(u, 0.06),
    "lag by flow": lambda u, p, c: lag(u, flow(p)),
    "lag by a power of flow": lambda u, p, c: lag(u, power(p)),
    "lag by temperature": lambda u, p, c: lag(u, warmth(p)),
    "lag, zero wanders": lambda u, p, c: wandering(u, c),
}


GIVEN = {
    "lag": [{"type": "first-order-lag", "time_constant_s": 6.0}],
    "dead-time": [{"type": "dead-time", "dead_time_s": 5.0}],
    "two-lags": [{"type": "first-order-lag", "time_constant_s": 4.0}] * 2,
    "asymmetric": [{"type": "asymmetric-lag", "rising_time_constant_s": 4.0, "falling_time_constant_s": 9.0}],
    "two-path": [{"type": "two-path-lag", "fast_time_constant_s": 4.0, "slow_time_constant_s": 60.0, "slow_share": 0.1}],
    "lag, then rate limit": [{"type": "first-order-lag", "time_constant_s": 4.0}, {"type": "slew-limit", "rate_per_s": 0.06}],
    "rate limit": [{"type": "slew-limit", "rate_per_s": 0.06}],
    "lag by a power of flow": [{"type": "flow-dependent-lag", "time_constant_s": 12.0, "reference_speed_m_per_s": 0.85,
                                "exponent": 1.0}],
}
GIVEN["lag, wild readings"] = GIVEN["lag, zero wanders"] = GIVEN["lag"]


def fixes(chance, count, hertz):
    """Errors of fixes, m: 0.5 that last for a minute."""
    keep = math.exp(-1 / 60 / hertz)
    found = [chance.gauss(0, 0.5)]
    while len(found) < count:
        found.append(keep * found[-1] + chance.gauss(0, 0.5 * math.sqrt(1 - keep * keep)))
    return found


def survey(file, name, seed, reference, hertz=1):
    """Writes a log of the sensor [name]."""
    chance = random.Random(seed)
    field = water(chance)
    places = track(chance)
    truths = [field(x, y) for x, y, _ in places]
    chance = random.Random(seed * 1000 + 7)
    shown = SENSORS[name](truths, places, chance)
    each = STEPS // hertz
    rows = range(each - 1, len(truths), each)
    east, north = fixes(chance, len(rows), hertz), fixes(chance, len(rows), hertz)
    with open(file, "w", newline="") as out:
        table = csv.writer(out)
        table.writerow(["time_s", "x_m", "y_m", "reading", "truth", "reference"])
        for i, row in enumerate(rows):
            read = shown[row] + chance.gauss(0, NOISE)
            if name == "lag, wild readings" and chance.random() < 0.01:
                read += chance.choice((-1, 1)) * chance.uniform(0.3, 3)
            x, y = (places[row][k] + off[i] + chance.gauss(0, 0.15) for k, off in ((0, east), (1, north)))
            known = truths[row] + chance.gauss(0, reference or 0.0)
            table.writerow([round((i + 1) / hertz, 3), f"{x:.2f}", f"{y:.2f}", f"{round(read / DIGIT) * DIGIT:.2f}", truths[row], f"{known:.4f}"])


def corrected(log, directory, reference, given):
    """Coverage, rms errors as measured and corrected, mean half width, and whether it says the delay is uneven."""
    out = pathlib.Path(directory) / "out"
    flags = [] if reference is None else ["--reference", "reference"]
    if given is not None:
        sensor = pathlib.Path(directory) / "sensor.json"
        sensor.write_text(json.dumps({"name": "true", "stages": given}))
        flags = ["--sensor", str(sensor)]
    subprocess.run([*PROGRAM, "correct", str(log), "--value", "reading", "--quiet", "--out", str(out), *flags], check=True)
    with open(out / "corrected.csv", newline="") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
    summary = json.loads((out / "summary.json").read_text())
    rms = lambda column: math.sqrt(sum((r[column] - r["truth"]) ** 2 for r in rows) / len(rows))
    held = sum(r["corrected_low"] <= r["truth"] <= r["corrected_high"] for r in rows) / len(rows)
    return (held, rms("reading"), rms("corrected"), summary["mean_half_width"],
            summary.get("agreement", {}).get("widened_for_unevenness", False))


def option(words, name):
    """Takes the option [name] and its number out of [words]; None where it is not there."""
    if name not in words:
        return None
    at = words.index(name)
    number = words[at + 1] if at + 1 < len(words) else ""
    del words[at:at + 2]
    return number


def main():
    words = sys.argv[1:]
    given = "--given" in words
    if given:
        words.remove("--given")
    reference, hertz = option(words, "--reference"), option(words, "--hertz")
    usage = __doc__ + "\nSensors: " + "; ".join(SENSORS)
    try:
        reference = None if reference is None else float(reference)
        hertz = 1 if hertz is None else int(hertz)
        seeds = [int(it) for it in words[0].split("-")] if words else []
    except ValueError:
        sys.exit(usage)
    if len(seeds) not in (1, 2) or hertz < 1 or STEPS % hertz or any(name not in SENSORS for name in words[1:]):
        sys.exit(usage)
    print("| sensor | holds: mean, each | rms error measured | corrected | half width | called uneven |")
    print("|---|---|---|---|---|---|")
    for name in words[1:] or (GIVEN if given else SENSORS):
        if given and name not in GIVEN:
            continue
        found = []
        for seed in range(seeds[0], seeds[-1] + 1):
            with tempfile.TemporaryDirectory() as directory:
                log = pathlib.Path(directory) / "log.csv"
                survey(log, name, seed, reference, hertz)
                found.append(corrected(log, directory, reference, GIVEN[name] if given else None))
        mean = lambda k: sum(it[k] for it in found) / len(found)
        each = " ".join(f"{it[0]:.3f}" for it in found)
        print(f"| {name} | {mean(0):.3f}: {each} | {mean(1):.3f} | {mean(2):.3f} | {mean(3):.3f} "
              f"| {sum(it[4] for it in found)} of {len(found)} |", flush=True)


if __name__ == "__main__":
    main()
