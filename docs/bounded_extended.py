#!/usr/bin/env python3
"""Prints the tables and draws the figures of the extended bounded filter and planner.

Usage: python3 docs/bounded_extended.py bounds|errors|figures [SEED]
Run from the repository's root after `mvn -q -pl simulator -am -DskipTests package`.
"""
import csv
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

PROGRAM = shlex.split(os.environ.get("STILLWATER", "java -jar simulator/target/stillwater.jar"))
SENSORS = ["outliers", "coarse", "asymmetric-slow-rise", "dead-time", "second-order-fast", "slew-limit"]
TIME_CONSTANT = 9.491221581029905
FIGURES = pathlib.Path("docs/figures")


def benchmark(seed, *arguments):
    """Rows of results.csv and bounds.csv, by field, filter, planner and move."""
    with tempfile.TemporaryDirectory() as out:
        command = [*PROGRAM, "benchmark", "--preset", "noisy", "--quiet", "--seed", seed, "--out", out, *arguments]
        subprocess.run(command, check=True)
        found = {}
        for name in ("results.csv", "bounds.csv"):
            with open(pathlib.Path(out) / name, newline="") as file:
                for row in csv.DictReader(file):
                    key = (row["field"], row["filter"], row["planner"], int(row["move"]))
                    found.setdefault(key, {}).update(row)
        return found


VARIANTS = (
    ("bounded", "bounded", "learned"),
    ("bounded-extended, response none", "bounded-extended", "none"),
    ("bounded-extended", "bounded-extended", "learned"),
)


def both(seed, *arguments):
    """Rows of [benchmark] with the response learned and with none, by "learned" and "none"."""
    return {
        "learned": benchmark(seed, "--filter", "bounded,bounded-extended", *arguments),
        "none": benchmark(seed, "--filter", "bounded-extended", "--response", "none", *arguments),
    }


def bounds(seed):
    """Share of cells whose bounds hold the truth, mean width and error, by sensor."""
    moves = [100, 500, 2000]
    tables = {field: [] for field in ("uniform", "gaussian")}
    for sensor in [None, *SENSORS]:
        spec = [] if sensor is None else ["--sensor", f"docs/sensors/noisy-{sensor}.json"]
        rows = both(seed, *spec, "--planner", "bounded-extended", "--checkpoints", ",".join(map(str, moves)))
        for field, table in tables.items():
            for name, kind, response in VARIANTS:
                at = [rows[response][field, kind, "bounded-extended", move] for move in moves]
                cells = [f'{float(r["coverage"]):.3f} ({float(r["mean_width"]):.3f})' for r in at]
                error = f'{float(at[-1]["mean_abs_error"]):.4f}'
                table.append(f"| {sensor or 'first order'} | {name} | " + " | ".join(cells) + f" | {error} |")
    for field, table in tables.items():
        print(f"\n| {field} field: sensor | filter | " + " | ".join(map(str, moves)) + " moves | error at 2000 |")
        print("|---|---|" + "---|" * (len(moves) + 1))
        print("\n".join(table))


def errors(seed):
    """Errors of the report's six and of the extended filter and planner."""
    moves = [50, 100, 200, 500, 1000, 2000]
    rows = benchmark(
        seed, "--filter", "bounded,averaging,bounded-extended",
        "--planner", "random-walk,lawnmower,bounded,bounded-extended", "--checkpoints", ",".join(map(str, moves)),
    )
    for field in ("uniform", "gaussian"):
        print(f"\n| {field} field | " + " | ".join(map(str, moves)) + " moves |\n|---|" + "---|" * len(moves))
        of_field = sorted({key[1:3] for key in rows if key[0] == field})
        for kind, planner in of_field:
            cells = [f'{float(rows[field, kind, planner, move]["mean_abs_error"]):.3g}' for move in moves]
            print(f"| {kind}, {planner} | " + " | ".join(cells) + " |")
        six = [key for key in of_field if key[0] != "bounded-extended" and key[1] != "bounded-extended"]
        best = [min(float(rows[field, *key, move]["mean_abs_error"]) for key in six) for move in moves]
        own = [float(rows[field, "bounded-extended", "bounded-extended", move]["mean_abs_error"]) for move in moves]
        print("| best of the report's six, over bounded-extended twice | "
              + " | ".join(f"{a / b:.3g}" for a, b in zip(best, own)) + " |")


def sensor(directory, stages):
    file = pathlib.Path(directory) / "sensor.json"
    file.write_text(json.dumps({"name": "figure", "stages": stages}))
    return ["--sensor", str(file)]


def lag(seconds):
    return {"type": "first-order-lag", "time_constant_s": seconds}


def second_lag(share):
    return [lag(TIME_CONSTANT * share / (1 + share))] if share else []


def noise(step):
    return [{"type": "noise", "standard_deviation": 0.002}, {"type": "quantisation", "step": step}]


def filter_figure(seed):
    """Coverage of the bounds by how far the sensor is of second order, and by how coarse it is."""
    shares = [0.0, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0]
    steps = [0.005, 0.01, 0.02, 0.03, 0.05]
    panels = []
    with tempfile.TemporaryDirectory() as directory:
        second = [
            (share, sensor, [lag(TIME_CONSTANT / (1 + share))] + second_lag(share) + noise(0.005)) for share in shares
        ]
        coarse = [(step, sensor, [lag(TIME_CONSTANT)] + noise(step)) for step in steps]
        for title, cases in (
            ("second time constant over the first, their sum kept", second),
            ("resolution of the sensor", coarse),
        ):
            lines = {name: [] for name, _, _ in VARIANTS}
            for x, make, stages in cases:
                rows = both(
                    seed, *make(directory, stages), "--environments", "20", "--field", "uniform",
                    "--planner", "bounded-extended", "--checkpoints", "500",
                )
                for name, kind, response in VARIANTS:
                    coverage = rows[response]["uniform", kind, "bounded-extended", 500]["coverage"]
                    lines[name].append((x, float(coverage)))
            panels.append((title, lines))
    draw(FIGURES / "bounded-extended-filter-fails.svg",
         "Share of cells whose bounds hold the truth, uniform field, 500 moves", panels, lowest=0.0, highest=1.0)


def planner_figure(seed):
    """Error of the planners over the random walk's by the readings in a cell and by the size of the field."""
    panels = []
    for title, flag, values, form in (
        ("readings in a cell", "--samples", [7, 8, 10, 15, 25, 40], str),
        ("cells along a side of the field", "--grid", [4, 6, 10, 16, 24], lambda n: f"{n}x{n}"),
    ):
        pairs = (
            ("extended filter, bounded-extended", "bounded-extended", "bounded-extended"),
            ("extended filter, bounded", "bounded-extended", "bounded"),
            ("plain filter, bounded-extended", "bounded", "bounded-extended"),
        )
        lines = {name: [] for name, _, _ in pairs}
        for value in values:
            cells = value * value if flag == "--grid" else 100
            moves = 5 * cells
            rows = benchmark(
                seed, flag, form(value), "--environments", "20", "--field", "gaussian",
                "--filter", "bounded,bounded-extended", "--planner", "random-walk,bounded,bounded-extended",
                "--checkpoints", str(moves),
            )
            error = {key: float(row["mean_abs_error"]) for key, row in rows.items()}
            for name, kind, planner in pairs:
                walk = error["gaussian", kind, "random-walk", moves]
                lines[name].append((value, error["gaussian", kind, planner, moves] / walk))
        panels.append((title, lines))
    draw(FIGURES / "bounded-extended-planner-fails.svg",
         "Error over that of the random walk with the same filter, Gaussian field, five moves a cell", panels,
         lowest=0.0, highest=max(y for _, lines in panels for points in lines.values() for _, y in points) * 1.1)


COLOURS = ["#666666", "#0072b2", "#d55e00"]


def draw(path, title, panels, lowest, highest):
    """Two panels side by side, a line a name."""
    width, height, left, top, side, gap = 900, 380, 60, 60, 350, 70
    tall = 240
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" '
           'font-size="12">', f'<rect width="{width}" height="{height}" fill="white"/>',
           f'<text x="{left}" y="28" font-size="15">{title}</text>']
    for place, (label, lines) in enumerate(panels):
        x0 = left + place * (side + gap)
        xs = [x for points in lines.values() for x, _ in points]

        def across(x):
            return x0 + side * (x - min(xs)) / (max(xs) - min(xs))

        def up(y):
            return top + tall * (1 - (y - lowest) / (highest - lowest))

        for i in range(5):
            y = lowest + (highest - lowest) * i / 4
            out.append(f'<line x1="{x0}" x2="{x0 + side}" y1="{up(y):.1f}" y2="{up(y):.1f}" stroke="#dddddd"/>')
            out.append(f'<text x="{x0 - 6}" y="{up(y) + 4:.1f}" text-anchor="end">{y:.2f}</text>')
        for x in sorted(set(xs)):
            out.append(f'<text x="{across(x):.1f}" y="{top + tall + 18}" text-anchor="middle">{x:g}</text>')
        out.append(f'<text x="{x0 + side / 2}" y="{top + tall + 38}" text-anchor="middle">{label}</text>')
        for colour, points in zip(COLOURS, lines.values()):
            line = " ".join(f"{across(x):.1f},{up(y):.1f}" for x, y in points)
            out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
            out += [f'<circle cx="{across(x):.1f}" cy="{up(y):.1f}" r="3" fill="{colour}"/>' for x, y in points]
    for i, name in enumerate(panels[0][1]):
        x = left + 270 * i
        out.append(f'<line x1="{x}" x2="{x + 24}" y1="{height - 20}" y2="{height - 20}" stroke="{COLOURS[i]}" '
                   'stroke-width="2"/>')
        out.append(f'<text x="{x + 30}" y="{height - 16}">{name}</text>')
    out.append("</svg>\n")
    path.write_text("\n".join(out))


def figures(seed):
    filter_figure(seed)
    planner_figure(seed)


if __name__ == "__main__":
    tables = {"bounds": bounds, "errors": errors, "figures": figures}
    if len(sys.argv) not in (2, 3) or sys.argv[1] not in tables:
        raise SystemExit(__doc__)
    tables[sys.argv[1]](sys.argv[2] if len(sys.argv) == 3 else "20261207")
