#!/usr/bin/env python3
"""Prints the tables of docs/results.md that are more than bars: errors after so many moves, boats, paths, patterns, maps.

Usage: python3 docs/results_tables.py --seed SEED [--only PART[,PART ...]] [--program COMMAND] [--environments N]
As docs/bars.py. Parts: errors, extended, boats, paths, directions, maps, outrun.
"""
import bars as bar
from bars import FIELDS, MOVES, at, lawnmower, without_lag, WRONG


def table(head, rows):
    print("| " + " | ".join(map(str, head)) + " |\n|" + "---|" * len(head))
    print("\n".join("| " + " | ".join(row) + " |" for row in rows) + "\n", flush=True)


def digits(number):
    return f"{number:.3g}"


def of_field(place, name, rows, kind, planner="lawnmower", moves=MOVES):
    return [name, *(digits(at(rows, move, kind, planner)[place]) for move in moves)]


def errors(run):
    own = "self-calibrating"
    plain = run.run("--planner", "lawnmower", "--filter", "interval,bounded,averaging")
    cases = [("a sensor without lag, averaging", without_lag(run), "averaging"), (own, lawnmower(run), own)]
    cases += [(f"the same, told a time constant 3 times {name}", lawnmower(run, belief=(*words, "--factor", "3")), own)
              for name, words in WRONG.items()]
    cases += [(kind, plain, kind) for kind in ("interval", "bounded", "averaging")]
    for place, field in enumerate(FIELDS):
        table([f"{field} field, lawnmower", *MOVES], [of_field(place, *case) for case in cases])


def extended(run):
    own = "bounded-extended"
    rows = run.run("--filter", "bounded,averaging,bounded-extended", "--planner", f"random-walk,lawnmower,bounded,{own}")
    six = [(kind, planner) for kind in ("bounded", "averaging") for planner in ("random-walk", "lawnmower", "bounded")]
    for place, field in enumerate(FIELDS):
        best = [min(at(rows, move, *pair)[place] for pair in six) for move in MOVES]
        twice = [at(rows, move, own, own)[place] for move in MOVES]
        found = [["best of the report's six", *map(digits, best)]]
        found += [of_field(place, f"{planner} planner, {kind} filter", rows, kind, planner)
                  for kind, planner in (("bounded", own), (own, "random-walk"), (own, "bounded"), (own, own))]
        found += [["how much lower the last is than the best of six", *(digits(a / b) for a, b in zip(best, twice))]]
        table([f"{field} field", *MOVES], found)
        table([f"{field} field: bounds hold", 100, 500, 2000],
              [[own, *(f"{at(rows, move, own, own, 'coverage')[place]:.3f}" for move in (100, 500, 2000))]])


def boats(run):
    moves = (25, 50, 75, 100, 115, 150, 200, 400)
    found = []
    for planners, kinds, numbers in (
        (("lawnmower", "random-walk", "bounded"), ("self-calibrating", "averaging", "interval", "bounded"), "1,4,8"),
        (("bounded-extended",), ("bounded-extended",), "1,4,8"),
        (("polygon-rrt",), ("self-calibrating", "bounded"), "1,4"),
    ):
        rows = run.run("--field", "uniform", "--planner", ",".join(planners), "--filter", ",".join(kinds), "--boats", numbers,
                       moves=moves)

        def error(kind, planner, move, n):
            return float(rows["uniform", kind, planner, move, n]["mean_abs_error"])
        for planner in planners:
            for kind in kinds:
                one, four = error(kind, planner, 400, 1), error(kind, planner, 115, 4)
                by = next((str(move) for move in moves if error(kind, planner, move, 4) <= one), "not by 400")
                many = digits(error(kind, planner, 115, 8)) if numbers.endswith("8") else ""
                found.append([planner, kind, digits(one), digits(four), f"{four / one:.2f}", by, many])
    table(["planner", "filter", "1 boat at 400", "4 boats at 115", "ratio", "4 boats there by", "8 boats at 115"], found)


def paths(run):
    moves, kinds = (50, 100, 400), ("self-calibrating", "bounded")
    planners = ("polygon-rrt", "lawnmower", "bounded", "random-walk")
    rows = run.run("--field", "uniform", "--planner", ",".join(planners), "--filter", ",".join(kinds), moves=moves)
    table(["planner", *(f"{kind} {move}" for kind in kinds for move in moves)],
          [[planner, *(digits(float(rows["uniform", kind, planner, move, 1]["mean_abs_error"]))
                       for kind in kinds for move in moves)] for planner in planners])


def directions(run):
    moves, found = (200, 500, 2000), []
    for pattern in ("hamiltonian-cycle", "back-and-forth", "rows-then-columns", "four-directions"):
        rows = run.run("--planner", "lawnmower", "--filter", "bounded", "--lawnmower", pattern, moves=moves)
        found.append([pattern, *(digits(at(rows, move, "bounded")[place]) for place in (0, 1) for move in moves)])
    table(["pattern", *(f"{field} {move}" for field in FIELDS for move in moves)], found)


def maps(run):
    moves = (50, 100, 200, 500)
    informed = run.run("--planner", "information", "--filter", "bayesian,self-calibrating", "--moves", "500", moves=moves)
    mown = run.run("--planner", "lawnmower", "--filter", "bayesian")
    for place, field in enumerate(FIELDS):
        rows = [of_field(place, f"{kind}, information", informed, kind, "information", moves) + ["", ""]
                for kind in ("bayesian", "self-calibrating")]
        table([f"{field} field", *MOVES], rows + [of_field(place, "bayesian, lawnmower", mown, "bayesian")])
        held = [[name, *(f"{at(found, move, 'bayesian', planner, 'coverage')[place]:.3f}" for move in moves)]
                for name, found, planner in (("information", informed, "information"), ("lawnmower", mown, "lawnmower"))]
        table([f"{field} field: intervals of bayesian hold", *moves], held)


def outrun(run):
    moves, kinds = (100, 200, 500), ("self-calibrating", "bayesian", "interval", "bounded")
    rows = run.run("--planner", "random-walk", "--filter", ",".join(kinds), "--environments", "40", preset="original",
                   moves=moves)
    table(["original settings, random walk", *(f"{field} {move}" for field in FIELDS for move in moves)],
          [[kind, *(digits(at(rows, move, kind, "random-walk")[place]) for place in (0, 1) for move in moves)]
           for kind in kinds])
    rows = lawnmower(run, "slew-limit")
    table(["slew limit of 0.01 a reading, lawnmower that moves on", *MOVES],
          [of_field(place, f"{field} field", rows, "self-calibrating") for place, field in enumerate(FIELDS)])


PARTS = {part.__name__: part for part in (errors, extended, boats, paths, directions, maps, outrun)}

if __name__ == "__main__":
    bar.drive(PARTS, __doc__)
