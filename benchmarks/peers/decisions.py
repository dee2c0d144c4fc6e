"""How long peers take to decide where to go on 10 x 10 cells, and what their way is worth.

    python3 benchmarks/peers/decisions.py [sgptools | pypolo]

sgptools: ContinuousSGP places ten waypoints, which are joined to a short tour; a boat sails it from cell to cell with a
sensor of 0.1 of the distance a reading, noise 0.002 and resolution 0.005, ten readings a cell, and a Gaussian process with
the planner's own kernel makes the map of what it read, as the package's examples do. PyPolo: a myopic decision among 1000
candidates with a Gaussian process on 100 points. Both unless one is named. Prints one line of JSON each; what is not
installed is said so.
"""
import json
import statistics
import sys
import time

import numpy as np

SIDE, FIELDS, WAYPOINTS, LENGTH, DEVIATION = 10, 40, 10, 2.0, 0.3
# Of sgptools' placement, which takes seconds.
RUNS = 4
PLACES = np.array([(x + 0.5, y + 0.5) for y in range(SIDE) for x in range(SIDE)])


def field(rng):
    """A mixture of Gaussians, as the program draws it."""
    total = np.zeros(len(PLACES))
    for _ in range(rng.integers(3, 7)):
        centre, sigma = rng.random(2) * (SIDE - 1) + 0.5, rng.uniform(1, 3)
        total += rng.uniform(0.5, 1) * np.exp(-((PLACES - centre) ** 2).sum(1) / (2 * sigma**2))
    return (total - total.min()) / (total.max() - total.min())


def tour(points, start):
    """Nearest neighbour, then turns of parts while one makes it shorter."""
    left, way = list(range(len(points))), []
    at = start
    while left:
        best = min(left, key=lambda i: abs(points[i] - at).sum())
        left.remove(best)
        way.append(best)
        at = points[best]

    def length(order):
        stops = np.vstack([start, points[order]])
        return abs(np.diff(stops, axis=0)).sum()

    improved = True
    while improved:
        improved = False
        for i in range(len(way) - 1):
            for j in range(i + 1, len(way)):
                turned = way[:i] + way[i:j + 1][::-1] + way[j + 1:]
                if length(turned) < length(way) - 1e-9:
                    way, improved = turned, True
    return points[way]


def cells_along(stops):
    """From cell to neighbouring cell, columns first."""
    at = [int(stops[0][0]), int(stops[0][1])]
    cells = [at[1] * SIDE + at[0]]
    for stop in stops[1:]:
        for axis in (0, 1):
            while at[axis] != int(stop[axis]):
                at[axis] += 1 if stop[axis] > at[axis] else -1
                cells.append(at[1] * SIDE + at[0])
    return cells


def sail(truth, cells, rng):
    """Mean reading of each cell on the way."""
    state, read = truth[cells[0]], {}
    for cell in cells:
        for _ in range(10):
            state += 0.1 * (truth[cell] - state)
            read.setdefault(cell, []).append(round((state + rng.normal(0, 0.002)) / 0.005) * 0.005)
    return {cell: np.mean(values) for cell, values in read.items()}


def mapped(read):
    def kernel(a, b):
        return DEVIATION**2 * np.exp(-((a[:, None] - b[None]) ** 2).sum(2) / (2 * LENGTH**2))

    cells = np.array(list(read))
    values = np.array(list(read.values()))
    gain = kernel(PLACES, PLACES[cells]) @ np.linalg.inv(kernel(PLACES[cells], PLACES[cells]) + 1e-3 * np.eye(len(cells)))
    return values.mean() + gain @ (values - values.mean())


def sgptools():
    import gpflow
    from sgptools.methods import ContinuousSGP

    kernel = gpflow.kernels.RBF(variance=DEVIATION**2, lengthscales=LENGTH)
    seconds, moves, errors = [], [], []
    rng = np.random.default_rng(1)
    for index in range(FIELDS):
        begin = time.perf_counter()
        if index < RUNS:
            # The waypoints do not depend on the readings; several runs for the time.
            np.random.seed(index)
            found = ContinuousSGP(WAYPOINTS, PLACES, kernel, 1e-3, X_candidates=PLACES).optimize()
            seconds.append(time.perf_counter() - begin)
        truth, start = field(rng), PLACES[rng.integers(len(PLACES))]
        way = cells_along(np.vstack([start, tour(found.reshape(-1, 2), start)]))
        moves.append(len(way))
        errors.append(abs(mapped(sail(truth, way, rng)) - truth).mean())
    # The first one has TensorFlow build its graph.
    return {"seconds": statistics.median(seconds[1:]), "first_seconds": seconds[0], "moves": round(np.mean(moves)),
            "error": np.mean(errors), "standard_error": np.std(errors, ddof=1) / FIELDS**0.5}


def pypolo():
    import pypolo
    from pypolo.objectives.entropy import gaussian_entropy

    rng = np.random.RandomState(1)
    places = rng.uniform(0, SIDE, (100, 2))
    kernel = pypolo.kernels.RBF(amplitude=1.0, lengthscale=LENGTH)
    model = pypolo.models.GPR(x_train=places, y_train=np.sin(places[:, :1]), kernel=kernel, noise=0.1)
    seconds = []
    for _ in range(30):
        begin = time.perf_counter()
        candidates = rng.uniform(0, SIDE, (1000, 2))
        _, deviation = model(candidates)
        scores = gaussian_entropy(deviation.ravel()) - np.hypot(*(candidates - 5).T)
        candidates[scores.argmax()]
        seconds.append(time.perf_counter() - begin)
    return {"seconds": statistics.median(seconds[1:])}


def main():
    peers = {"sgptools": sgptools, "pypolo": pypolo}
    for name in sys.argv[1:] or list(peers):
        try:
            found = peers[name]()
        except ImportError as missing:
            found = {"not_installed": str(missing)}
        print(json.dumps({"peer": name, **found}))


if __name__ == "__main__":
    main()
