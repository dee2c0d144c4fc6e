#!/usr/bin/env python3
"""Prints the tables of the-planner-surprise.md: one `stillwater benchmark` run a row.

Usage: python3 docs/planner_surprise.py TABLE [SEED], TABLE one of original, choice, horizon, extremes.
Run from the repository's root after `mvn -q -pl simulator -am -DskipTests package`.
"""
import csv
import pathlib
import subprocess
import sys
import tempfile

JAR = "simulator/target/stillwater.jar"


def benchmark(arguments, seed, name="results.csv"):
    with tempfile.TemporaryDirectory() as out:
        command = ["java", "-jar", JAR, "benchmark", "--quiet", "--seed", seed, "--out", out, *arguments]
        subprocess.run(command, check=True)
        with open(pathlib.Path(out) / name, newline="") as file:
            return list(csv.DictReader(file))


def error(rows, field, planner, move):
    for row in rows:
        key = (row["field"], row["planner"], row["filter"], row["move"])
        if key == (field, planner, "bounded", str(move)):
            return f'{float(row["mean_abs_error"]):.4f} ± {float(row["standard_error"]):.4f}'
    raise SystemExit(f"no row for {field}, {planner}, move {move}")


def table(title, variants, moves, field, seed):
    print(f"\n{title}\n\n| planner | " + " | ".join(str(m) for m in moves) + " |\n|---|" + "---|" * len(moves))
    for name, planner, arguments in variants:
        checkpoints = ",".join(str(m) for m in moves)
        rows = benchmark(
            ["--field", field, "--filter", "bounded", "--planner", planner, "--checkpoints", checkpoints, *arguments],
            seed,
        )
        print(f"| {name} | " + " | ".join(error(rows, field, planner, m) for m in moves) + " |", flush=True)


def original(seed):
    base = ["--preset", "original"]
    variants = [
        ("random walk (diagonal)", "random-walk", base),
        ("random walk (edge)", "random-walk", [*base, "--walk", "edge"]),
    ]
    for choice in ("last-polled", "best"):
        for execution in ("whole-path", "single-step"):
            arguments = [*base, "--choice", choice, "--execution", execution]
            variants.append((f"bounded, {choice}, {execution}", "bounded", arguments))
    for field in ("uniform", "gaussian"):
        table(f"Original settings, {field} field, error after each number of moves", variants, [20, 50, 100, 200, 500], field, seed)


def choice(seed):
    variants = [("random walk", "random-walk", [])]
    for chosen in ("best", "last-polled"):
        for execution in ("whole-path", "single-step"):
            variants.append((f"{chosen}, {execution}", "bounded", ["--choice", chosen, "--execution", execution]))
    variants.append(("best, whole-path, visits not discounted", "bounded", ["--no-discount-visits"]))
    for field in ("uniform", "gaussian"):
        table(f"Report settings, {field} field", variants, [50, 100, 200, 500, 1000, 2000], field, seed)


def horizon(seed):
    variants = []
    for moves, expansions in ((1, 200), (3, 200), (5, 200), (10, 200), (20, 200), (10, 2000), (20, 2000)):
        arguments = ["--horizon", str(moves), "--expansions", str(expansions)]
        variants.append((f"horizon {moves}, {expansions} expansions", "bounded", arguments))
    for field in ("uniform", "gaussian"):
        table(f"Horizon, report settings, {field} field", variants, [50, 100, 200, 500, 1000, 2000], field, seed)


def extremes(seed):
    moves = [500, 2000, 6000]
    print("\n| field | planner | move | local extremes, share of cells | share of the error |\n|---|---|---|---|---|")
    arguments = ["--filter", "bounded", "--planner", "random-walk,bounded", "--checkpoints", ",".join(map(str, moves))]
    for row in benchmark(arguments, seed, "extremes.csv"):
        print(f'| {row["field"]} | {row["planner"]} | {row["move"]} | {float(row["share_of_cells"]):.2f} | {float(row["share_of_error"]):.2f} |')


if __name__ == "__main__":
    tables = {"original": original, "choice": choice, "horizon": horizon, "extremes": extremes}
    if len(sys.argv) not in (2, 3) or sys.argv[1] not in tables:
        raise SystemExit(__doc__)
    tables[sys.argv[1]](sys.argv[2] if len(sys.argv) == 3 else "1")
