"""The report's experiment as loops that numba compiles; the same as experiment_numpy.py, one environment after the other.

    python3 benchmarks/peers/experiment_numba.py [ENVIRONMENTS] [MOVES]

The time to compile is not counted: everything is run once with few moves before.
"""
import sys
import time

import numpy as np
from numba import njit

SIDE, CELLS, ALPHA, SAMPLES, EPSILON = 10, 100, 0.1, 10, 5e-4
HORIZON, EXPANSIONS, MOST_CHANGE = 10, 200, 0.5
NODES = 4 * EXPANSIONS + 1
WALK, CYCLE, PLANNER = 0, 1, 2
TOUR = np.array([row * SIDE for row in range(SIDE)] + [
    row * SIDE + column for row in reversed(range(SIDE))
    for column in (range(1, SIDE) if (SIDE - 1 - row) % 2 == 0 else range(SIDE - 1, 0, -1))])


@njit(cache=False)
def neighbour(cell, way):
    column, row = cell % SIDE, cell // SIDE
    if way == 0:
        return cell - 1 if column > 0 else -1
    if way == 1:
        return cell + 1 if column < SIDE - 1 else -1
    if way == 2:
        return cell - SIDE if row > 0 else -1
    return cell + SIDE if row < SIDE - 1 else -1


@njit(cache=False)
def before(priorities, a, b):
    return priorities[a] > priorities[b] or (priorities[a] == priorities[b] and a > b)


@njit(cache=False)
def plan(lower, upper, start, sensor, cells, parents, depths, values, sensors, priorities, heap, path):
    """Fills path backwards with the best path's cells; how many there are."""
    cells[0], parents[0], depths[0], values[0], sensors[0], priorities[0] = start, -1, 0, 0.0, sensor, 0.0
    heap[0] = 0
    size, waiting, best = 1, 1, 0
    order = np.arange(4)
    for _ in range(EXPANSIONS):
        if waiting == 0:
            break
        node = heap[0]
        waiting -= 1
        moved, place = heap[waiting], 0
        while True:
            child = 2 * place + 1
            if child >= waiting:
                break
            if child + 1 < waiting and before(priorities, heap[child + 1], heap[child]):
                child += 1
            if not before(priorities, heap[child], moved):
                break
            heap[place] = heap[child]
            place = child
        heap[place] = moved
        for last in range(3, 0, -1):
            other = np.random.randint(last + 1)
            order[last], order[other] = order[other], order[last]
        for way in order:
            cell = neighbour(cells[node], way)
            if cell < 0:
                continue
            visits, at = 0, node
            while at >= 0:
                if cells[at] == cell:
                    visits += 1
                at = parents[at]
            middle = (lower[cell] + upper[cell]) / 2
            gain = max(0.0, upper[cell] - lower[cell] - abs(middle - sensors[node])) / (1 + visits)
            cells[size], parents[size], depths[size] = cell, node, depths[node] + 1
            values[size] = values[node] + gain
            sensors[size] = sensors[node] + max(-MOST_CHANGE, min(MOST_CHANGE, middle - sensors[node]))
            priorities[size] = values[size] / depths[size]
            if values[size] > values[best]:
                best = size
            if depths[size] < HORIZON:
                place = waiting
                waiting += 1
                while place > 0 and before(priorities, size, heap[(place - 1) // 2]):
                    heap[place] = heap[(place - 1) // 2]
                    place = (place - 1) // 2
                heap[place] = size
            size += 1
    length = 0
    while best > 0:
        path[length] = cells[best]
        length += 1
        best = parents[best]
    return length


@njit(cache=False)
def trial(truth, way, moves, tour):
    lower, upper = np.zeros(CELLS), np.ones(CELLS)
    sums, counts = np.zeros(CELLS), np.zeros(CELLS)
    window, medians = np.zeros(3), np.zeros(5)
    cells, parents, depths = np.zeros(NODES, np.int64), np.zeros(NODES, np.int64), np.zeros(NODES, np.int64)
    values, sensors, priorities = np.zeros(NODES), np.zeros(NODES), np.zeros(NODES)
    heap, path, left = np.zeros(NODES, np.int64), np.zeros(HORIZON, np.int64), 0
    cell = tour[0] if way == CYCLE else np.random.randint(CELLS)
    state, since = truth[cell], 0
    for move in range(moves):
        if move > 0:
            to = -1
            if way == CYCLE:
                to = tour[move % CELLS]
            elif way == WALK:
                while to < 0:
                    to = neighbour(cell, np.random.randint(4))
            else:
                if left == 0:
                    left = plan(lower, upper, cell, state, cells, parents, depths, values, sensors, priorities, heap, path)
                if left > 0:
                    left -= 1
                    to = path[left]
            if to >= 0 and to != cell:
                cell, since = to, 0
        for _ in range(SAMPLES):
            state += ALPHA * (truth[cell] - state)
            sums[cell] += state
            counts[cell] += 1
            window[since % 3] = state
            since += 1
            if since < 3:
                continue
            a, b, c = window
            medians[since % 5] = max(min(a, b), min(max(a, b), c))
            if since < 7:
                continue
            slope = 0.0
            for k in range(5):
                slope += (k - 2) * medians[(since + 1 + k) % 5]
            if slope / 10 > EPSILON:
                lower[cell] = max(lower[cell], state)
            elif slope / 10 < -EPSILON:
                upper[cell] = min(upper[cell], state)
    bounded, average = 0.0, 0.0
    for k in range(CELLS):
        bounded += abs((lower[k] + upper[k]) / 2 - truth[k])
        average += abs((sums[k] / counts[k] if counts[k] > 0 else 0.5) - truth[k])
    return bounded / CELLS, average / CELLS


def run(truth, moves):
    return [(name, np.array([trial(field, way, moves, TOUR) for field in truth]).T)
            for name, way in (("random-walk", WALK), ("lawnmower", CYCLE), ("bounded", PLANNER))]


def main():
    environments = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    moves = int(sys.argv[2]) if len(sys.argv) > 2 else 2000
    truth = np.random.default_rng(1).random((environments, CELLS))
    run(truth[:1], 20)
    begin = time.perf_counter()
    found = run(truth, moves)
    print("seconds %.3f" % (time.perf_counter() - begin))
    for name, errors in found:
        for kind, error in zip(("bounded", "averaging"), errors):
            print("%s, %s: %.4f +- %.4f" % (name, kind, error.mean(), error.std(ddof=1) / len(error) ** 0.5))


if __name__ == "__main__":
    main()
