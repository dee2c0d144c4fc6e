"""The report's experiment the numpy way: all environments at once wherever numpy can, the planner's tree with heapq.

    python3 benchmarks/peers/experiment_numpy.py [ENVIRONMENTS] [MOVES] [AT_ONCE]

The same as `stillwater benchmark --field uniform`: a first-order lag of 0.1 of the distance a reading, ten readings a
move, bounded and averaging filter, edge walk, Hamiltonian cycle and bounded planner (horizon 10, 200 expansions, whole
paths). AT_ONCE environments are done at once, all unless given; 1 is how a script is first written. Prints seconds and the six mean absolute errors, which must agree with the program's within their standard errors.
"""
import heapq
import sys
import time

import numpy as np

SIDE, CELLS, ALPHA, SAMPLES, EPSILON = 10, 100, 0.1, 10, 5e-4
HORIZON, EXPANSIONS, MOST_CHANGE = 10, 200, 0.5
NEIGHBOURS = [
    [n for n, there in ((c - 1, c % SIDE > 0), (c + 1, c % SIDE < SIDE - 1), (c - SIDE, c >= SIDE),
                        (c + SIDE, c < CELLS - SIDE)) if there]
    for c in range(CELLS)
]
TREND = np.arange(-2.0, 3.0) / 10


class Filters:
    """Both filters' maps in every environment."""

    def __init__(self, environments):
        self.all = np.arange(environments)
        self.lower = np.zeros((environments, CELLS))
        self.upper = np.ones((environments, CELLS))
        self.sums = np.zeros((environments, CELLS))
        self.counts = np.zeros((environments, CELLS))
        self.since = np.zeros(environments, int)
        self.values = np.zeros((environments, 3))
        self.medians = np.zeros((environments, 5))

    def read(self, cells, reading):
        self.sums[self.all, cells] += reading
        self.counts[self.all, cells] += 1
        self.values[:, :2] = self.values[:, 1:]
        self.values[:, 2] = reading
        a, b, c = self.values.T
        self.medians[:, :4] = self.medians[:, 1:]
        self.medians[:, 4] = np.maximum(np.minimum(a, b), np.minimum(np.maximum(a, b), c))
        self.since += 1
        slope = self.medians @ TREND
        full = self.since >= 7
        up = np.flatnonzero(full & (slope > EPSILON))
        self.lower[up, cells[up]] = np.maximum(self.lower[up, cells[up]], reading[up])
        down = np.flatnonzero(full & (slope < -EPSILON))
        self.upper[down, cells[down]] = np.minimum(self.upper[down, cells[down]], reading[down])

    def enter(self, changed):
        self.since[changed] = 0

    def errors(self, truth):
        average = np.where(self.counts > 0, self.sums / np.maximum(self.counts, 1), 0.5)
        bounded = (self.lower + self.upper) / 2
        return abs(bounded - truth).mean(1), abs(average - truth).mean(1)


def walk(environments, moves, rng, _filters):
    cells = rng.integers(CELLS, size=environments)
    draws = rng.integers(12, size=(moves, environments))
    yield cells
    for move in range(1, moves):
        cells = np.array([NEIGHBOURS[c][d % len(NEIGHBOURS[c])] for c, d in zip(cells, draws[move])])
        yield cells


def cycle(environments, moves, _rng, _filters):
    tour = [row * SIDE for row in range(SIDE)]
    for row in reversed(range(SIDE)):
        columns = range(1, SIDE) if (SIDE - 1 - row) % 2 == 0 else range(SIDE - 1, 0, -1)
        tour += [row * SIDE + column for column in columns]
    for move in range(moves):
        yield np.full(environments, tour[move % CELLS])


def plan(lower, upper, start, sensor, rng):
    """The best path of the tree, without the start. Plain lists are several times faster than arrays here."""
    cells, parents, depths, values, sensors = [start], [-1], [0], [0.0], [sensor]
    queue, best = [(0.0, 0)], 0
    orders = rng.permuted(np.tile(np.arange(4), (EXPANSIONS, 1)), axis=1).tolist()
    for order in orders:
        if not queue:
            break
        node = -heapq.heappop(queue)[1]
        path, at = [], node
        while at >= 0:
            path.append(cells[at])
            at = parents[at]
        near = NEIGHBOURS[cells[node]]
        for way in order:
            if way >= len(near):
                continue
            cell = near[way]
            middle = (lower[cell] + upper[cell]) / 2
            gain = max(0.0, upper[cell] - lower[cell] - abs(middle - sensors[node])) / (1 + path.count(cell))
            change = max(-MOST_CHANGE, min(MOST_CHANGE, middle - sensors[node]))
            new, depth = len(cells), depths[node] + 1
            cells.append(cell)
            parents.append(node)
            depths.append(depth)
            values.append(values[node] + gain)
            sensors.append(sensors[node] + change)
            if values[new] > values[best]:
                best = new
            if depth < HORIZON:
                heapq.heappush(queue, (-values[new] / depth, -new))
    path = []
    while best > 0:
        path.append(cells[best])
        best = parents[best]
    return path


def planner(environments, moves, rng, filters):
    cells = rng.integers(CELLS, size=environments)
    paths = [[] for _ in range(environments)]
    yield cells
    for _ in range(1, moves):
        cells = cells.copy()
        for e in range(environments):
            if not paths[e]:
                lower, upper = filters.lower[e].tolist(), filters.upper[e].tolist()
                paths[e] = plan(lower, upper, int(cells[e]), float(filters.values[e, 2]), rng)
            if paths[e]:
                cells[e] = paths[e].pop()
        yield cells


def trials(truth, ways, moves, rng):
    environments = len(truth)
    filters = Filters(environments)
    everywhere, before, state = np.arange(environments), None, None
    for cells in ways(environments, moves, rng, filters):
        here = truth[everywhere, cells]
        if before is None:
            state = here.copy()
        else:
            filters.enter(cells != before)
        for _ in range(SAMPLES):
            state = state + ALPHA * (here - state)
            filters.read(cells, state)
        before = cells
    return filters.errors(truth)


def main():
    environments = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    moves = int(sys.argv[2]) if len(sys.argv) > 2 else 2000
    at_once = int(sys.argv[3]) if len(sys.argv) > 3 else environments
    rng = np.random.default_rng(1)
    truth = rng.random((environments, CELLS))
    begin = time.perf_counter()
    found = []
    for name, ways in (("random-walk", walk), ("lawnmower", cycle), ("bounded", planner)):
        parts = [trials(truth[i:i + at_once], ways, moves, rng) for i in range(0, environments, at_once)]
        found.append((name, np.concatenate(parts, axis=1)))
    print("seconds %.3f" % (time.perf_counter() - begin))
    for name, errors in found:
        for kind, error in zip(("bounded", "averaging"), errors):
            print("%s, %s: %.4f +- %.4f" % (name, kind, error.mean(), error.std(ddof=1) / len(error) ** 0.5))


if __name__ == "__main__":
    main()
