#!/usr/bin/env python3
"""Draws the figure of core/docs/IntervalFilter.md: how many cells its bounds hold as the sensor leaves its assumption.

Usage: python3 docs/interval_fails.py [SEED]
Run from the repository's root after `mvn -q -pl simulator -am -DskipTests package`; STILLWATER as in bounded_extended.py,
whose sensors and drawing are used. Prints the numbers, too.
"""
import sys
import tempfile

from bounded_extended import FIGURES, TIME_CONSTANT, benchmark, draw, lag, noise, second_lag, sensor

PATTERNS = {"cells entered from one side": "hamiltonian-cycle", "from four": "four-directions"}


def held(seed, spec):
    """Share of cells held behind two lawnmowers, uniform field, the slowest response told as that of the noisy preset."""
    found = {}
    for name, pattern in PATTERNS.items():
        rows = benchmark(seed, *spec, "--environments", "20", "--field", "uniform", "--planner", "lawnmower", "--filter",
                         "interval", "--slowest", str(TIME_CONSTANT), "--lawnmower", pattern, "--checkpoints", "500")
        found[name] = float(rows["uniform", "interval", "lawnmower", 500]["coverage"])
    return found


def main():
    seed = sys.argv[1] if len(sys.argv) == 2 else "20263102"
    panels = []
    with tempfile.TemporaryDirectory() as directory:
        slower = [(ratio, [lag(ratio * TIME_CONSTANT)]) for ratio in (0.5, 0.8, 1.0, 1.1, 1.25, 1.5, 2.0, 3.0)]
        second = [(share, [lag(TIME_CONSTANT / (1 + share))] + second_lag(share)) for share in (0.0, 0.1, 0.2, 0.35, 0.5, 1.0)]
        for title, cases in (("time constant over the slowest that was told", slower),
                             ("second time constant over the first, their sum as told", second)):
            lines = {name: [] for name in PATTERNS}
            for x, stages in cases:
                for name, share in held(seed, sensor(directory, stages + noise(0.005))).items():
                    lines[name].append((x, share))
                    print(f"{title} {x:g}, {name}: {share:.3f}", flush=True)
            panels.append((title, lines))
    draw(FIGURES / "interval-fails.svg", "Share of cells whose bounds hold the truth, uniform field, 500 moves", panels,
         lowest=0.0, highest=1.0)


if __name__ == "__main__":
    main()
