"""The linear systems of single steps in SciPy's conjugate gradients and in CHOLMOD.

    python linear_systems.py cg|cholmod FOLDER STATES [--repeats 3]

FOLDER and STATES are what `cargo bench --locked --bench speed -- step NAME folder=FOLDER` writes there and prints. The systems are
those of the paper, (M + Δt L) x = M λ with start λ; those of the program are the same in another basis, so that a residual
relative to that of the start means the same. Prints one line of JSON.
"""

import argparse
import json
import pathlib
import time

import numpy as np

from paper_method import Surface, normalized, solve

# Seconds that SciPy gets for a solve; what takes longer is a bound.
PATIENCE = 20.0


def timed(work):
    begin = time.perf_counter()
    result = work()
    return time.perf_counter() - begin, result


def cholmod(matrix, right, repeats):
    """Milliseconds of CHOLMOD's three parts with the better of its two orderings; supernodal."""
    from sksparse.cholmod import analyze

    best = None
    for ordering in ("metis", "amd"):
        analysis, factor = timed(lambda: analyze(matrix, mode="supernodal", ordering_method=ordering))
        parts = []
        for _ in range(repeats):
            factorization, _ = timed(lambda: factor.cholesky_inplace(matrix))
            parts.append((factorization, timed(lambda: factor(right))[0]))
        factorization, solution = np.median(parts, axis=0)
        if best is None or factorization < best["factorize"]:
            best = dict(ordering=ordering, analyze=analysis, factorize=factorization, solve=solution)
    return best


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("solver", choices=["cg", "cholmod"])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("states")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()
    surface = Surface(options.folder)
    results = []
    for state in json.loads(options.states):
        frames = np.load(options.folder / f"{state['frames']}.npy")
        dt = state["dt"] * surface.unit
        assembly, matrix = timed(lambda: surface.matrix(state["stiffness"], dt, frames))
        csr = matrix.tocsr()
        start = frames.reshape(-1)
        right = np.repeat(surface.areas, 4) * start
        if options.solver == "cholmod":
            results.append(cholmod(csr.tocsc(), right, options.repeats))
            continue
        result = dict(dt=state["dt"], assembly=assembly, solves=[])
        for tolerance in (ours["tolerance"] for ours in state["solves"][:2]):
            # The better of the two formats.
            times = {"BSR": [], "CSR": []}
            for _ in range(options.repeats):
                for name, form in (("BSR", matrix), ("CSR", csr)):
                    seconds, (solution, iterations) = timed(lambda: solve(form, right, start, tolerance, PATIENCE))
                    times[name].append((seconds, iterations, solution is not None))
            name = min(times, key=lambda name: np.median([time for time, _, _ in times[name]]))
            result["solves"].append(
                dict(
                    tolerance=tolerance,
                    iterations=times[name][0][1],
                    seconds=[time for time, _, _ in times[name]],
                    done=all(done for _, _, done in times[name]),
                    format=name,
                )
            )
        # Both sides solve the same problem: compare with the frames that the program's own tight solve gives.
        if len(frames) < 100_000:
            solved = np.load(options.folder / f"solved_phase{state['phase']}.npy")
            solution, _ = solve(matrix, right, start, 1e-10)
            result["largest_difference"] = float(np.abs(normalized(solution.reshape(-1, 4)) - solved).max())
        results.append(result)
    print(json.dumps(results))


if __name__ == "__main__":
    main()
