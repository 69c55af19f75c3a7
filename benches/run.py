"""Runs all measurements, each in a process of its own, and writes the tables; started by run.sh."""

import argparse
import datetime
import importlib.metadata
import json
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import time
from statistics import median

from tables import exponent, report, say, seconds, table

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCRATCH = ROOT / "target" / "bench"
CORES = len(os.sched_getaffinity(0))
MIB = 2.0**20
PARTS = ("memory", "steps", "paper", "sizes", "threads", "film")


def run(command, threads=None, blas_threads=None):
    """The last line that a process prints, as JSON."""
    environment = dict(os.environ)
    if threads:
        environment["RAYON_NUM_THREADS"] = str(threads)
    if blas_threads:
        environment["OPENBLAS_NUM_THREADS"] = str(blas_threads)
    print("  " + " ".join(str(word)[:60] for word in command[-4:]), file=sys.stderr, flush=True)
    done = subprocess.run([str(word) for word in command], env=environment, cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    return json.loads(done.stdout.splitlines()[-1])


class Bench:
    def __init__(self, options):
        self.quick, self.mesh = options.quick, options.mesh
        self.irregular = options.mesh or "hare"
        self.speed = self.build(["bench", "--bench", "speed", "--no-run"], "speed")
        self.program = self.build(["build", "--release"], "immerse")
        # Whether to hold NumPy to one thread; the part `steps` finds out.
        self.blas_threads = 1
        self.numpy_threads = "one"

    @staticmethod
    def build(words, target):
        command = ["cargo", words[0], "--locked", "--message-format=json", *words[1:]]
        built = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=True).stdout
        messages = [json.loads(line) for line in built.splitlines() if line.startswith("{")]
        return next(m["executable"] for m in messages if m.get("executable") and m["target"]["name"] == target)

    def ours(self, *words, threads=None):
        return run([self.speed, *words], threads=threads)

    def python(self, script, *words, blas_threads=None):
        return run([sys.executable, ROOT / "benches" / script, *words], blas_threads=blas_threads)

    def machine(self):
        cpu = next((l.split(":")[1].strip() for l in open("/proc/cpuinfo") if "model name" in l), platform.machine())
        memory = int(re.search(r"MemTotal:\s+(\d+)", open("/proc/meminfo").read())[1]) / MIB
        said = lambda *command: subprocess.run(command, cwd=ROOT, capture_output=True, text=True).stdout.strip()
        version = importlib.metadata.version
        suitesparse = said("dpkg-query", "-W", "-f", "${Version}", "libsuitesparse-dev")
        dirty = " and changes" if said("git", "status", "--porcelain", "--untracked-files=no") else ""
        say("# Results of `benches/run.sh`")
        say()
        say(
            f"{datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d}, commit {said('git', 'rev-parse', '--short', 'HEAD')}{dirty}."
        )
        say(
            f"{cpu}, {CORES} cores, {memory:.0f} GiB, {platform.system()} {platform.release()}; load at the start {os.getloadavg()[0]:.1f}."
        )
        say(
            f"{said('rustc', '--version').split(' (')[0]}; Python {platform.python_version()}, NumPy {version('numpy')}, "
            f"SciPy {version('scipy')}; SuiteSparse {suitesparse} by scikit-sparse {version('scikit-sparse')}."
        )
        say("Times are medians of runs in turn; ratios are of times of the same run of this command.")
        if self.quick:
            say("Quick: small sizes only.")
        say()

    def memory(self):
        rates = {threads: self.ours("triad", threads=threads)["bytes_per_second"] for threads in (1, CORES)}
        name = "sphere-29k" if self.quick else "sphere-1M"
        rows = []
        for threads, rate in rates.items():
            measured = self.ours("step", name, "repeats=3", threads=threads)
            for state in measured["states"]:
                first, last = state["solves"][2], state["solves"][1]
                more = last["iterations"] - first["iterations"]
                if more == 0:
                    continue  # solved directly
                each = (median(last["seconds"]) - median(first["seconds"])) / more
                moved = measured["bytes_per_iteration"] * measured["faces"]
                rows.append(
                    [
                        threads,
                        f"{rate / 1e9:.1f} GB/s",
                        f"{state['dt']:g}",
                        f"{each * 1e3:.2f} ms",
                        f"{moved / 1e6:.0f} MB",
                        f"{moved / each / 1e9:.1f} GB/s",
                        f"{moved / each / rate:.0%}",
                    ]
                )
        say("## Bytes moved by an iteration of the inner solve, against the memory")
        say()
        say(
            f"`{name}`, {measured['faces']} faces. An iteration of preconditioned conjugate gradients moves "
            f"{measured['bytes_per_iteration']:.0f} bytes a face (counted in `benches/speed/step.rs`). What is less than all of the triad's rate is arithmetic."
        )
        say()
        table(["threads", "triad", "dt", "one iteration", "it moves", "rate", "share of triad"], rows)

    def steps(self):
        names = ["sphere-29k"] if self.quick else ["sphere-29k", "sphere-200k", "sphere-1M"]
        rows, direct, times = [], [], {}
        differences = []
        for name in [self.irregular, *names]:
            folder = SCRATCH / pathlib.Path(name).stem
            repeats = 5 if name in names[:1] else 3
            ours = self.ours("step", name, f"repeats={repeats}", f"folder={folder}")
            repeats = 1 if name == "sphere-1M" else repeats
            states = json.dumps(ours["states"])
            arguments = (folder, states, "--repeats", repeats)
            if name == self.irregular:
                scipy = self.calibrate(arguments)
            else:
                scipy = self.python("linear_systems.py", "cg", *arguments, blas_threads=self.blas_threads)
            faces = ours["faces"]
            for state, theirs in zip(ours["states"], scipy):
                if "largest_difference" in theirs:
                    differences.append(theirs["largest_difference"])
                times.setdefault(state["phase"], {})[faces] = median(state["solves"][0]["seconds"])
                without_solve = median(state["solves"][-1]["seconds"])
                for mine, other in zip(state["solves"], theirs["solves"]):
                    a, b = median(mine["seconds"]), median(other["seconds"])
                    more = "" if other["done"] else "> "
                    rows.append(
                        [
                            pathlib.Path(name).stem,
                            faces,
                            f"{state['dt']:g}",
                            f"{mine['tolerance']:g}",
                            seconds(a),
                            mine["iterations"],
                            more + seconds(b),
                            f"{more}{other['iterations']} ({other['format']})",
                            f"{more}{b / a:.1f}",
                            seconds(a - without_solve) if mine["iterations"] else "–",
                            f"{more}{b / (a - without_solve):.1f}" if mine["iterations"] else "–",
                            more + seconds(b + theirs["assembly"]),
                            f"{more}{(b + theirs['assembly']) / a:.1f}",
                        ]
                    )
            if faces < 400_000:
                # CHOLMOD factorizes a million faces in more memory than most machines have.
                for state, parts in zip(ours["states"], self.python("linear_systems.py", "cholmod", *arguments)):
                    a = median(state["solves"][1]["seconds"])
                    total = parts["factorize"] + parts["solve"]
                    direct.append(
                        [
                            pathlib.Path(name).stem,
                            faces,
                            f"{state['dt']:g}",
                            parts["ordering"],
                            seconds(parts["analyze"]),
                            seconds(parts["factorize"]),
                            seconds(parts["solve"]),
                            seconds(a),
                            f"{total / a:.1f}",
                        ]
                    )
        say("## One gradient step, against SciPy's conjugate gradients on the same system")
        say()
        say(
            "Ours is the whole step: assembly, factorization, solve; the first phase is solved directly. Frames are those of a relaxation under way, from random ones. "
            f"Tightly solved, both sides give the same frames up to {max(differences):.0e}. SciPy's matrix is in the better of two formats; NumPy's threads: {self.numpy_threads}."
        )
        say()
        table(
            [
                "surface",
                "faces",
                "dt",
                "tolerance",
                "ours",
                "iterations",
                "SciPy's cg",
                "iterations",
                "ratio",
                "our cg alone",
                "ratio",
                "SciPy with assembly",
                "ratio",
            ],
            rows,
        )
        say("## The same systems in CHOLMOD")
        say()
        say(
            "Supernodal, on all cores, the better of METIS and AMD. Ours is the step solved to 1e-3; the ratio is that of factorization and solve to it."
        )
        say()
        table(["surface", "faces", "dt", "order", "analyze", "factorize", "solve", "ours", "ratio"], direct)
        if not self.quick:
            say(
                "Time of a step by the number of faces, 200 thousand to a million: "
                + ", ".join(f"phase {phase}: exponent {exponent(by_faces):.2f}" for phase, by_faces in times.items())
                + "."
            )
            say()

    def calibrate(self, arguments):
        """SciPy's results with NumPy's threads as they come or with one, whichever is faster, which is then kept."""
        tried = {
            threads: self.python("linear_systems.py", "cg", *arguments, blas_threads=threads) for threads in (None, 1)
        }
        total = {
            threads: sum(median(solve["seconds"]) for result in results for solve in result["solves"])
            for threads, results in tried.items()
        }
        self.blas_threads = min(total, key=total.get)
        self.numpy_threads = (
            f"one, which takes {total[1] / total[None]:.0%} of the time that they take as they come"
            if self.blas_threads
            else f"as they come, which takes {total[None] / total[1]:.0%} of the time of one"
        )
        return tried[self.blas_threads]

    def paper(self):
        cases = [(f"torus-{c}", "torus", 0.025) for c in ("00", "01", "10", "11")]
        cases += [(self.irregular, "short", 0.005), (self.irregular, "even", 0.005)]
        rows, parts = [], []
        for name, schedule, target in cases:
            folder = SCRATCH / f"{pathlib.Path(name).stem}-start"
            self.ours("problem", name, f"folder={folder}")
            arguments = (folder, "--schedule", schedule, "--target", target)
            repeats = 1 if self.quick else 3
            ours, whole, theirs = [], [], []
            for _ in range(repeats):
                ours.append(self.ours("whole", name, f"target={target}"))
                theirs.append(self.python("paper_method.py", *arguments, blas_threads=self.blas_threads))
                whole.append(self.ours("whole", name))
                if theirs[-1]["seconds"] > 60:
                    break  # so long that once is enough
            a, b = (median([result["seconds"] for result in results]) for results in (ours, theirs))
            mine, paper, end = ours[0], theirs[0], whole[0]
            result = lambda r: f"{r['l2_length_error']:.2%}, {r['rims']}, {r['pinch_points']}"
            rows.append(
                [
                    pathlib.Path(name).stem,
                    mine["faces"],
                    schedule,
                    f"{target:.1%}",
                    seconds(a),
                    mine["steps"],
                    result(mine),
                    seconds(b),
                    paper["steps"],
                    result(paper),
                    f"{b / a:.1f}" if paper["arrived"] else f"({b / a:.1f}, did not arrive)",
                    seconds(median([r["seconds"] for r in whole])),
                    result(end),
                ]
            )
            shares = ", ".join(
                f"{key.replace('_', ' ')} {value / paper['seconds']:.0%}" for key, value in paper["parts"].items()
            )
            parts.append(
                f"{pathlib.Path(name).stem} ({schedule}): {paper['inner_iterations']} inner iterations; {shares}."
            )
        say("## From random frames to a surface, against the paper's method in NumPy/SciPy")
        say()
        say(
            "The same lengths, spin connection and random frames; both stop when the L2 length error is below the target with neither rims nor pinch points. "
            "Without imports and reading. Results are error, rims, pinch points. The schedules of the paper's method are in `benches/paper_method.py`: "
            "`short` is fitted to the bunny and the target, `even` is not. The last two columns are the run with default phases to its end."
        )
        say()
        table(
            [
                "surface",
                "faces",
                "schedule",
                "target",
                "ours",
                "steps",
                "result",
                "NumPy/SciPy",
                "steps",
                "result",
                "ratio",
                "ours to the end",
                "result",
            ],
            rows,
        )
        say("Where NumPy/SciPy's time goes: " + " ".join(parts))
        say()

    def sizes(self):
        rows, phase_rows, per_step, peaks = [], [], {}, {}
        for name in ["sphere-6k", self.irregular, "sphere-29k"] + ([] if self.quick else ["sphere-200k", "sphere-1M"]):
            run = self.ours("whole", name)
            faces, stem = run["faces"], pathlib.Path(name).stem
            peaks[faces] = run["peak_bytes"]
            in_phases = sum(phase["seconds"] for phase in run["phases"])
            per_step[faces] = in_phases / run["steps"]
            rows.append(
                [
                    stem,
                    faces,
                    seconds(run["seconds"]),
                    seconds(run["setup_seconds"]),
                    run["steps"],
                    run["inner_iterations"],
                    run["restarts"],
                    f"{run['l2_length_error']:.2%}, {run['rims']}, {run['pinch_points']}",
                    seconds(per_step[faces]),
                    f"{run['peak_bytes'] / MIB:.0f} MiB",
                ]
            )
            for number, phase in enumerate(run["phases"]):
                if phase["steps"]:
                    phase_rows.append(
                        [
                            stem,
                            faces,
                            number + 1,
                            phase["steps"],
                            phase["inner_iterations"],
                            f"{phase['inner_iterations'] / phase['steps']:.1f}",
                            seconds(phase["seconds"]),
                            seconds(phase["seconds"] / phase["steps"]),
                        ]
                    )
        say("## Sizes")
        say()
        say(
            "Whole runs with default phases from random frames; the Poisson problem is factorized once a run, the system of a step once a step. "
            "Peak memory is that of the whole process."
        )
        say()
        table(
            [
                "surface",
                "faces",
                "whole",
                "set-up",
                "steps",
                "inner iterations",
                "restarts",
                "error, rims, pinch points",
                "a step",
                "peak memory",
            ],
            rows,
        )
        table(["surface", "faces", "phase", "steps", "inner iterations", "inner a step", "time", "time a step"], phase_rows)
        if not self.quick:
            (small, large) = sorted(peaks)[-2:]
            each = (peaks[large] - peaks[small]) / (large - small)
            power = exponent(per_step)
            say(
                f"Time of a step from {small} to {large} faces: exponent {power:.2f}. Memory: {each:.0f} bytes a face more, so that ten million faces take "
                f"{(peaks[large] + each * (1e7 - large)) / 2**30:.1f} GiB, and a step {seconds(per_step[large] * (1e7 / large) ** power)}."
            )
            say()

    def threads(self):
        rows = []
        for name in ["torus-10"] if self.quick else ["torus-10", self.irregular]:
            times = {1: [], CORES: []}
            for _ in range(1 if self.quick else 3):
                for threads in times:
                    times[threads].append(self.ours("whole", name, threads=threads)["seconds"])
            one, all_ = (median(times[threads]) for threads in (1, CORES))
            rows.append([pathlib.Path(name).stem, seconds(one), seconds(all_), f"{one / all_:.2f}"])
        say("## Threads, whole runs")
        say()
        table(["surface", "1 thread", f"{CORES} threads", "ratio"], rows)

    def film(self):
        frames = 12 if self.quick else 240
        text = (ROOT / "scenes" / "ricci_torus.toml").read_text()
        text = re.sub(r"\[look\.color\][^\[]*", "", text)
        text = re.sub(r"(?m)^frames = \d+", f"frames = {frames}", text)
        text = re.sub(r"(?ms)^\[checks\].*", "", text)
        SCRATCH.mkdir(parents=True, exist_ok=True)
        (SCRATCH / "film.toml").write_text(text)
        (SCRATCH / "film-first.toml").write_text(text + '\n[camera]\nframed = "first"\n')

        def timed(command, name, folder):
            words = [self.program, command, SCRATCH / f"{name}.toml", "--out", SCRATCH / folder]
            words += ["--restart"] if command == "simulate" else ["--size", "1920x1080"]
            begin = time.perf_counter()
            done = subprocess.run([str(word) for word in words], cwd=ROOT, capture_output=True, text=True)
            if done.returncode:
                sys.exit(done.stderr)
            return time.perf_counter() - begin

        for folder in ("film", "film-first", "film-parts"):
            shutil.rmtree(SCRATCH / folder, ignore_errors=True)
        whole, first = timed("run", "film", "film"), timed("run", "film-first", "film-first")
        simulate, render = timed("simulate", "film", "film-parts"), timed("render", "film", "film-parts")
        say(f"## A film: Ricci flow on a torus of 6200 faces, {frames} frames of 1920 x 1080 in the default look")
        say()
        say(
            'Simulation and pictures share the processors. With `framed = "first"` pictures are made from the first frame on, '
            "by default as soon as the extents of all frames are known."
        )
        say()
        table(
            ["`immerse run`", "a frame", '`framed = "first"`', "`simulate` alone", "`render` alone", "their sum"],
            [[seconds(t) for t in (whole, whole / frames, first, simulate, render, simulate + render)]],
        )


def main():
    parser = argparse.ArgumentParser(
        prog="benches/run.sh", description="Times everything and writes benches/RESULTS.md."
    )
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"of {', '.join(PARTS)}; all if none is named")
    parser.add_argument(
        "--mesh",
        type=os.path.abspath,
        help="the Stanford bunny, or another sphere, in place of a hare of the same size",
    )
    parser.add_argument("--quick", action="store_true", help="small sizes, few repeats; writes below target/ only")
    parser.add_argument("--out", type=pathlib.Path, help="where the tables go")
    options = parser.parse_args()
    if unknown := set(options.parts) - set(PARTS):
        parser.error(f"there is no part {', '.join(unknown)}; write some of {', '.join(PARTS)}")
    SCRATCH.mkdir(parents=True, exist_ok=True)
    whole = not options.quick and not options.parts
    out = options.out or (ROOT / "benches" if whole else SCRATCH) / "RESULTS.md"
    bench = Bench(options)
    bench.machine()
    for part in PARTS:
        if not options.parts or part in options.parts:
            getattr(bench, part)()
            out.write_text("\n".join(report))
    print(f"written to {out}", file=sys.stderr)


if __name__ == "__main__":
    main()
