"""Progress, stopping, Ctrl-C, threads, and memory that is handed over."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import immerse


def test_progress_is_told_of_every_step(sphere):
    _, _, metric = sphere
    seen = []
    shape = immerse.Immersion(metric, seed=0).relax(progress=seen.append)
    assert len(seen) == shape.report["steps"]
    last = seen[-1]
    assert last.doing == "relax" and (last.frame, last.frames, last.rims) == (1, 1, 0)
    # Polish comes after the last step.
    polish = shape.report["polish"]
    assert last.error == pytest.approx(polish["l2_length_error_before"], rel=0.5)
    assert shape.report["l2_length_error"] < 1e-12 and polish["ending"] == "isometric"
    assert [p.phase for p in seen] == sorted(p.phase for p in seen) or shape.report["restarts"]


def test_false_stops_and_none_goes_on(sphere):
    _, _, metric = sphere
    steps = []

    def until_third(progress):
        steps.append(progress.step)
        return False if len(steps) == 3 else None

    with pytest.raises(immerse.Stopped, match="stopped after 3 steps"):
        immerse.Immersion(metric, seed=0).relax(progress=until_third)
    assert len(steps) == 3


def test_what_a_callback_raises_comes_out(sphere):
    _, _, metric = sphere

    def refuse(progress):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        immerse.Immersion(metric, seed=0).relax(progress=refuse)


LONG = """
import signal, immerse
signal.signal(signal.SIGINT, signal.default_int_handler)  # whoever runs the tests in the background ignores it
mesh, positions = immerse.Mesh.shape("torus", columns=160, rows=70)
metric = immerse.Metric.from_positions(mesh, positions)
immersion = immerse.Immersion(metric, spin_class="01", seed=0)
print("begins", flush=True)
try:
    immersion.relax()
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.skipif(not hasattr(signal, "SIGINT") or os.name != "posix", reason="SKIPPED: no signals here")
def test_ctrl_c_interrupts_within_a_second():
    process = subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "begins\n"
    time.sleep(2.0)
    sent = time.monotonic()
    process.send_signal(signal.SIGINT)
    assert process.stdout.readline() == "interrupted\n"
    took = time.monotonic() - sent
    assert process.wait() == 0
    assert took < 1.0, f"it took {took:.2f} s"


def test_other_threads_run_meanwhile(sphere):
    _, _, metric = sphere
    ticks, over = [], threading.Event()

    def tick():
        while not over.is_set():
            ticks.append(None)
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.monotonic()
    immerse.Immersion(metric, seed=0).relax()
    took = time.monotonic() - start
    over.set()
    thread.join()
    assert len(ticks) > 20 * took, f"{len(ticks)} ticks in {took:.2f} s"


def base_of(array):
    while isinstance(array.base, np.ndarray):
        array = array.base
    return array.base


def test_results_are_the_memory_that_was_computed_in(shape):
    for array in (shape.positions, shape.frames, shape.rims, shape.asked_lengths):
        assert not array.flags.owndata and array.flags.c_contiguous
        assert not array.flags.writeable
        assert type(base_of(array)).__name__ == "PySliceContainer", "a container of Rust holds it"
        with pytest.raises(ValueError):
            array[...] = 0
    assert shape.positions is shape.positions and shape.positions.dtype == np.float64
    assert shape.positions.ctypes.data == shape.positions.ctypes.data


def test_memory_outlives_the_surface(sphere):
    _, _, metric = sphere
    positions = immerse.Immersion(metric, seed=0).relax().positions
    before = positions.sum()
    for _ in range(3):
        immerse.Immersion(metric, seed=1, accuracy=0.1).relax()
    assert positions.sum() == before


def test_arguments_may_be_read_only_and_are_not_changed(sphere):
    mesh, positions, metric = sphere
    assert not positions.flags.writeable
    copy = positions.copy()
    immerse.Immersion(immerse.Metric(mesh, metric.lengths), start=positions).relax()
    assert (copy == positions).all()
