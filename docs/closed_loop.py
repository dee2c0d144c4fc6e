#!/usr/bin/env python3
"""Sails docs/missions/pond.json in two processes and in one, and compares the maps: the table of docs/closed-loop.md.

    python3 docs/closed_loop.py java -jar simulator/target/stillwater.jar

What follows the script's name is how `stillwater` is started. For each seed: `simulate` in one process; `virtual-boat` and
`drive` at 60 times wall time over TCP and, on Linux, over a pseudo-terminal; `replay` of each `drive`'s log. The error is the
mean absolute difference of the cells' values from the water's mean in the cell, which `virtual-boat --out` writes.
"""
import csv
import os
import subprocess
import sys
import tempfile
import time

SEEDS = [int(s) for s in os.environ.get("SEEDS", "101 102 103 104 105").split()]
SPEED = os.environ.get("SPEED", "60")
MISSION = os.path.join(os.path.dirname(os.path.abspath(__file__)), "missions", "pond.json")
BOAT = ["--probe-period", "1"]


def column(path, name):
    with open(path, newline="") as file:
        return [float(row[name]) if row[name] else None for row in csv.DictReader(file)]


def error(values, truth):
    both = [(v, t) for v, t in zip(values, truth) if v is not None]
    return sum(abs(v - t) for v, t in both) / len(both)


def said(process, word):
    for line in process.stdout:
        if line.startswith(word + " "):
            return line.split()[1]
    sys.exit(f"virtual-boat never named its {word}")


def two_processes(stillwater, seed, wire, directory):
    boat = subprocess.Popen(
        stillwater + ["virtual-boat", MISSION, *wire, "--speed", SPEED, "--once", "--seed", str(seed)]
        + ["--out", f"{directory}/boat", *BOAT],
        stdout=subprocess.PIPE, text=True)
    board, phone = said(boat, "board"), said(boat, "phone")
    begun = time.monotonic()
    drive = subprocess.run(
        stillwater + ["drive", MISSION, "--port", board, "--phone", phone, "--yes", "--numbers-only"]
        + ["--out", f"{directory}/drive"],
        stdout=subprocess.PIPE, text=True, check=True).stdout
    wall = time.monotonic() - begun
    boat.stdout.read()
    if boat.wait() != 0:
        sys.exit("virtual-boat failed")
    lines = drive.strip().splitlines()
    simulated = float(lines[-2].split(" s ")[0])
    readings = int(lines[-1].split("; ")[1].split()[0])
    stops = sum("holding" in line for line in lines)
    replay = subprocess.run(
        stillwater + ["replay", f"{directory}/drive/mission.txt", "--out", f"{directory}/again", "--numbers-only"],
        stdout=subprocess.PIPE, text=True, check=True).stdout
    same = "every step as recorded; the map is that of the recorded readings, bit for bit" in replay
    with open(f"{directory}/drive/cells.csv") as own, open(f"{directory}/again/cells.csv") as again:
        same = same and own.read() == again.read()
    return simulated, wall, readings, stops, same


def main():
    stillwater = sys.argv[1:]
    if not stillwater:
        sys.exit(__doc__)
    wires = {"TCP": ["--tcp", "0"]}
    if sys.platform.startswith("linux"):
        wires["pseudo-terminal"] = ["--pty"]
    print("| seed | wire | simulated | wall | readings | stops | error | in one process | ratio | replayed bit for bit |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    ratios = {name: [] for name in wires}
    for seed in SEEDS:
        with tempfile.TemporaryDirectory() as scratch:
            subprocess.run(
                stillwater + ["simulate", MISSION, "--headless", "--quiet", "--seed", str(seed), *BOAT]
                + ["--out", f"{scratch}/one"],
                stdout=subprocess.DEVNULL, check=True)
            for name, wire in wires.items():
                directory = f"{scratch}/{name}"
                simulated, wall, readings, stops, same = two_processes(stillwater, seed, wire, directory)
                truth = column(f"{directory}/boat/truth.csv", "mean")
                own = error(column(f"{directory}/drive/cells.csv", "value"), truth)
                one = error(column(f"{scratch}/one/cells.csv", "value"), truth)
                ratios[name].append(own / one)
                print(
                    f"| {seed} | {name} | {simulated:.0f} s | {wall:.1f} s | {readings} | {stops} | {own:.4f} | {one:.4f} "
                    f"| {own / one:.3f} | {'yes' if same else 'NO'} |", flush=True)
    for name, all_of in ratios.items():
        print(f"\n{name}: mean ratio {sum(all_of) / len(all_of):.3f}, {min(all_of):.3f} to {max(all_of):.3f}")


main()
