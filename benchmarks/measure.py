#!/usr/bin/env python3
"""Measures what docs/performance.md says, and writes its tables. On an otherwise idle machine, from the repository's root:

    python3 benchmarks/measure.py

takes ten minutes and needs nothing but the build's own tools; peers are measured where PEERS_PYTHON names a Python that
has numpy and numba, SGPTOOLS_PYTHON and PYPOLO_PYTHON ones that have these (benchmarks/peers/requirements*.txt). Parts by
themselves: `jmh`, `programs`, `scaling`, `peers` as arguments; `--no-build` takes the jars as they are; `--short` gives
noisy numbers in a quarter of the time.
"""
import csv
import json
import os
import platform
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
JAR = os.path.join(ROOT, "simulator/target/stillwater.jar")
BENCHMARKS = os.path.join(ROOT, "benchmarks/target/benchmarks.jar")
LAUNCHER = os.path.join(ROOT, "simulator/src/main/launcher/stillwater")
PAGE = os.path.join(ROOT, "docs/performance.md")
KEPT = os.path.join(ROOT, "benchmarks/target/measured.json")
SHORT = "--short" in sys.argv

# A peer that takes longer, its start included, is not waited for; the table says so.
MOST_SECONDS_OF_A_PEER = 300


def write(section, lines):
    """Puts lines between the section's marks in the page."""
    with open(PAGE) as page:
        text = page.read()
    begin, end = "<!-- %s -->\n" % section, "<!-- end of %s -->" % section
    head, rest = text.split(begin)
    tail = rest.split(end)[1]
    with open(PAGE, "w") as page:
        page.write(head + begin + "\n".join(lines) + "\n" + end + tail)
    print("\n".join(lines), flush=True)


def keep(**numbers):
    """Numbers that other parts need, from one call to the next."""
    found = json.load(open(KEPT)) if os.path.exists(KEPT) else {}
    found.update(numbers)
    with open(KEPT, "w") as file:
        json.dump(found, file)
    return found


def run(command, **settings):
    """Wall and processor seconds, and the largest resident set in MB, of a command that must succeed."""
    begin = time.perf_counter()
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, **settings)
    errors = child.stderr.read()
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit("%s failed: %s" % (" ".join(command), errors.decode()))
    return time.perf_counter() - begin, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def best(command, times):
    """Medians of some runs; the largest memory of all."""
    runs = [run(command) for _ in range(1 if SHORT else times)]
    return [statistics.median(r[0] for r in runs), statistics.median(r[1] for r in runs), max(r[2] for r in runs)]


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)] + ["| " + " | ".join(r) + " |" for r in rows]


def digits(number):
    return "%.3g" % number if number < 1000 else "%.0f" % number


def machine():
    model = "unknown processor"
    if os.path.exists("/proc/cpuinfo"):
        names = [line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
        model = names[0] if names else model
    java = subprocess.run(["java", "-version"], capture_output=True, text=True).stderr.split("\n")[0]
    load = os.getloadavg()[0]
    write("machine", ["%s, %d processors; %s; Python %s; load before the measurement %.1f."
                      % (model, os.cpu_count(), java, platform.python_version(), load)])


def build():
    subprocess.run(["mvn", "-q", "-Dkotlin.compiler.daemon=false", "-Pbenchmarks", "-pl", "benchmarks", "-am",
                    "-Dmaven.test.skip=true", "package"], cwd=ROOT, check=True)


BARS = {
    ("FilterBenchmark.update", "bounded"): "5 ns, 0 B",
    ("FilterBenchmark.update", "self-calibrating"): "10 ns, 0 B",
    ("PlannerBenchmark.decide", "200"): "15 us, 0 B",
    ("PlannerBenchmark.decide", "10000"): "667 us (15 million expansions/s)",
    ("CodecBenchmark.lines", ""): "2 million lines/s",
    ("BayesianBenchmark.move", "100x100"): "50 ms",
    ("ExperimentBenchmark.oneField", "uniform, 1"): "300 ms",
    ("ExperimentBenchmark.oneField", "gaussian, 1"): "300 ms",
}


def jmh():
    result = os.path.join(ROOT, "benchmarks/target/jmh.json")
    times = ["-wi", "2", "-w", "200ms", "-i", "3", "-r", "200ms"] if SHORT else \
        ["-wi", "4", "-w", "500ms", "-i", "5", "-r", "500ms"]
    quick = "Filter|Sensor|Planner|Codec|Mission"
    rest = "Bayesian|Experiment|Diagnose|Map"
    found = []
    for pattern, settings in ((quick, times), (rest, [])):
        subprocess.run(["java", "-jar", BENCHMARKS, pattern, "-f", "1", "-prof", "gc", "-rf", "json", "-rff", result]
                       + settings, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
        found += json.load(open(result))
    rows, kept, medians = [], {}, {}
    for one in found:
        name = ".".join(one["benchmark"].split(".")[-2:])
        values = one.get("params") or {}
        params = ", ".join(values[k] for k in sorted(values))
        score, unit = one["primaryMetric"]["score"], one["primaryMetric"]["scoreUnit"].replace("/op", "")
        raw = [value for fork in one["primaryMetric"]["rawData"] for value in fork]
        spread = "%s to %s" % (digits(min(raw)), digits(max(raw)))
        allocated = one["secondaryMetrics"].get("gc.alloc.rate.norm", {}).get("score", float("nan"))
        unit = unit.replace("ops/s", "lines/s")
        rows.append([name, params, digits(score) + " " + unit, spread, digits(allocated), BARS.get((name, params), "")])
        kept[name + " " + params] = score
        medians[name + " " + params] = statistics.median(raw)
    keep(jmh=kept)
    write("jmh", table(["benchmark", "of", "mean", "lowest to highest", "B each", "bar"], rows))
    # Medians: the first rounds of two workers share the processors with the compiler.
    one, two = (medians["ExperimentBenchmark.oneField uniform, %d" % n] for n in (1, 2))
    write("workers", ["From one to two workers the uniform field takes %.2f times less (medians; bar 1.9)." % (one / two)])


def alternatives():
    """Ways to start the program: its name, the command, whether it is the one that is recommended."""
    archive = os.path.join(tempfile.mkdtemp(prefix="stillwater-"), "classes.jsa")
    rehearsal = archive + ".out"
    # Interpreted: see the launcher.
    run(["java", "-Xint", "-XX:ArchiveClassesAtExit=" + archive, "-jar", JAR, "benchmark", "--environments", "1",
         "--moves", "5", "--out", rehearsal])
    serial = ["-XX:+UseSerialGC"]
    small = serial + ["-Xms32m", "-XX:MinHeapFreeRatio=10", "-XX:MaxHeapFreeRatio=25"]
    quick = ["-XX:TieredStopAtLevel=1"]
    later = ["-XX:Tier4InvocationThreshold=80000", "-XX:Tier4MinInvocationThreshold=9600",
             "-XX:Tier4CompileThreshold=240000", "-XX:Tier4BackEdgeThreshold=640000"]
    shared = ["-XX:SharedArchiveFile=" + archive]
    return [("`java -jar stillwater.jar`", ["java", "-jar", JAR])] + [
        (name, ["java"] + options + ["-jar", JAR]) for name, options in [
            ("serial collector", serial), ("serial collector, small heap", small), ("first compiler only", quick),
            ("class archive", shared), ("class archive, serial collector, small heap", shared + small),
            ("the same, optimising compiler sixteen times later", shared + small + later),
            ("the same, first compiler only", shared + small + quick)]
    ] + [("launcher `stillwater`", [LAUNCHER])]


def into(scratch, name):
    """Arguments for output in a directory of its own: no command writes over what another one wrote."""
    return ["--quiet", "--out", os.path.join(scratch, name)]


def programs():
    scratch = tempfile.mkdtemp(prefix="stillwater-")
    os.environ["XDG_CACHE_HOME"] = os.path.join(scratch, "cache")
    os.environ.pop("STILLWATER_JAR", None)
    run([LAUNCHER, "--help"])
    # The launcher's archive is made in the background by its first use.
    for _ in range(120):
        made = os.path.join(scratch, "cache/stillwater")
        if any(name.endswith(".jsa") for name in os.listdir(made)):
            break
        time.sleep(0.5)
    log = os.path.join(scratch, "long.csv")
    subprocess.run([sys.executable, os.path.join(ROOT, "benchmarks/long_survey.py"), "1000000", log], check=True)
    rows = []
    for name, command in alternatives():
        help_time = best(command + ["--help"], 5)
        benchmark = best(command + ["benchmark"] + into(scratch, "experiment"), 3)
        mapped = best(command + ["map", log, "--value", "do_mg_l"] + into(scratch, "map"), 3)
        rows.append([name] + ["%.2f s (%.2f s)" % (part[0], part[1]) for part in (help_time, benchmark, mapped)] +
                    ["%.0f MB" % mapped[2]])
    rows.append(["bar", "0.35 s", "2.5 s", "3 s", "300 MB"])
    write("programs", table(["started by", "`--help`", "`benchmark`", "`map`, 1 million rows", "its memory"], rows))
    shutil.rmtree(scratch)


def kilobytes(used):
    """Of a heap before and after: what was freed in between may be more than a small map takes."""
    return "%.0f" % (used / 1024) if used > 0 else "not told"


def scaling():
    lines = subprocess.run(["java", "-XX:+UseSerialGC", "-cp", BENCHMARKS, "stillwater.speed.DecisionTimesKt"],
                           capture_output=True, text=True, check=True).stdout.strip().split("\n")
    rows = [line.split("\t") for line in lines[1:]]
    write("decisions", table(["cells", "moves", "readings", "first, ms", "mean, ms", "99 %, ms", "longest, ms", "memory, kB"],
                             [row[:7] + [kilobytes(int(row[7]))] for row in rows]))
    scratch = tempfile.mkdtemp(prefix="stillwater-")
    out = into(scratch, "experiment")
    rows = []
    for readings in (100_000, 1_000_000, 3_000_000):
        log = os.path.join(scratch, "long.csv")
        subprocess.run([sys.executable, os.path.join(ROOT, "benchmarks/long_survey.py"), str(readings), log], check=True)
        rows.append(["`map`, %d rows" % readings] + best([LAUNCHER, "map", log, "--value", "do_mg_l"] + into(scratch, "map"), 1))
    for environments in (50, 100, 200, 400):
        rows.append(["`benchmark`, %d environments a field" % environments] +
                    best([LAUNCHER, "benchmark", "--environments", str(environments)] + out, 1))
    for side in (10, 20, 40, 80):
        command = [LAUNCHER, "benchmark", "--environments", "20", "--grid", "%dx%d" % (side, side)] + out
        rows.append(["`benchmark`, 20 environments of %d cells" % side**2] + best(command, 1))
    for boats in (1, 2, 4, 8):
        command = [LAUNCHER, "benchmark", "--environments", "20", "--boats", str(boats)] + out
        rows.append(["`benchmark`, 20 environments, %d boats" % boats] + best(command, 1))
    write("scaling", table(["", "wall", "processor", "memory"],
                           [[r[0], "%.2f s" % r[1], "%.2f s" % r[2], "%.0f MB" % r[3]] for r in rows]))
    shutil.rmtree(scratch)


def said_by(python, script, *arguments):
    """What a peer's script printed, or None and why there is nothing."""
    command = [python, os.path.join(ROOT, "benchmarks/peers", script), *arguments]
    try:
        found = subprocess.run(command, capture_output=True, text=True, timeout=MOST_SECONDS_OF_A_PEER)
    except subprocess.TimeoutExpired:
        return None, "not finished after %d s" % MOST_SECONDS_OF_A_PEER
    except OSError as failed:
        return None, "not measured: %s" % failed
    if found.returncode != 0:
        return None, "not measured: " + (found.stderr.strip().split("\n") or [""])[-1]
    return found.stdout, None


def peers():
    kept = keep().get("jmh") or sys.exit("run the part jmh first: peers are held against it")
    own = kept["ExperimentBenchmark.oneField uniform, 1"] / 1000
    rows = [["Stillwater, one field, one worker", "%.3f s" % own, "1", ""]]
    python = os.environ.get("PEERS_PYTHON", sys.executable)
    for name, script, arguments, factor, bar in (
        ("numpy, one environment after the other (10, times ten)", "experiment_numpy.py", ["10", "2000", "1"], 10, "150"),
        ("numpy, all environments at once", "experiment_numpy.py", ["100", "2000"], 1, ""),
        ("numba, compiled before", "experiment_numba.py", ["100", "2000"], 1, ""),
    ):
        said, why = said_by(python, script, *arguments)
        if said is None:
            rows.append([name, why, "", bar])
        else:
            seconds = float(said.split()[1])
            rows.append([name, "%.2f s" % (seconds * factor), digits(seconds * factor / own), bar])
    write("experiment", table(["100 environments x 6 combinations x 2000 moves", "time", "ratio", "bar"], rows))
    decisions(kept)


def decisions(kept):
    decision = kept["PlannerBenchmark.decide 200"] / 1e6
    move = kept["BayesianBenchmark.move 10x10"] / 1e3
    rows = [["bounded planner, 200 expansions", "%.1f us" % (decision * 1e6), "1", ""],
            ["Bayesian map brought up to date, ten readings included", "%.0f us" % (move * 1e6), digits(move / decision), ""]]
    notes = []
    for peer in ("sgptools", "pypolo"):
        python = os.environ.get(peer.upper() + "_PYTHON", sys.executable)
        said, why = said_by(python, "decisions.py", peer)
        one = json.loads(said.strip().split("\n")[-1]) if said else {}
        bar = "1000" if peer == "sgptools" else ""
        if "seconds" not in one:
            rows.append([peer, why or "not measured: " + one["not_installed"], "", bar])
            continue
        rows.append([peer, "%.1f ms" % (one["seconds"] * 1e3), digits(one["seconds"] / decision), bar])
        if "error" in one:
            notes.append("At %d moves in the Gaussian field the map along sgptools' ten waypoints has a mean absolute error of "
                         "%.4f ± %.4f; the information planner with the Bayesian map %s." %
                         (one["moves"], one["error"], one["standard_error"], ours(one["moves"])))
    write("decision-ratios", table(["a decision on 10 x 10 cells", "time", "ratio", "bar"], rows) + [""] + notes)


def ours(moves):
    scratch = tempfile.mkdtemp(prefix="stillwater-")
    run(["java", "-jar", JAR, "benchmark", "--preset", "noisy", "--field", "gaussian", "--filter", "bayesian", "--planner",
         "information", "--environments", "40", "--checkpoints", str(moves), "--seed", "20261121", "--quiet", "--out", scratch])
    row = list(csv.DictReader(open(os.path.join(scratch, "results.csv"))))[-1]
    shutil.rmtree(scratch)
    return "%.4f ± %.4f" % (float(row["mean_abs_error"]), float(row["standard_error"]))


def main():
    parts = {"jmh": jmh, "programs": programs, "scaling": scaling, "peers": peers}
    wanted = [a for a in sys.argv[1:] if not a.startswith("--")] or list(parts)
    unknown = [a for a in wanted if a not in parts]
    if unknown:
        sys.exit("expected some of %s, found %s" % (", ".join(parts), ", ".join(unknown)))
    begin = time.time()
    if "--no-build" not in sys.argv:
        build()
    machine()
    for part in wanted:
        parts[part]()
    print("%.0f s" % (time.time() - begin))


if __name__ == "__main__":
    main()
