"""Lengths in, surfaces out: what is found, which class it has, and that it is the same each time."""

import os
import subprocess
import sys

import numpy as np
import pytest

import immerse


def test_sphere_from_lengths(sphere, shape):
    mesh, positions, metric = sphere
    assert shape.report["l2_length_error"] < 1e-3
    assert shape.report["rims"] == 0 and len(shape.rims) == 0
    assert shape.spin_class == ""
    radii = np.linalg.norm(shape.positions - shape.positions.mean(axis=0), axis=1)
    assert np.ptp(radii) < 0.01, "it is round"
    ends = shape.positions[mesh.edges]
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    np.testing.assert_allclose(lengths, shape.lengths, rtol=1e-12)
    errors = lengths / metric.lengths - 1
    np.testing.assert_allclose(shape.length_errors, errors, atol=1e-12)
    assert np.sqrt(np.mean(errors**2)) == pytest.approx(shape.report["l2_length_error"], rel=1e-9)
    assert shape.enclosed_volume == pytest.approx(4 * np.pi / 3, rel=0.05)
    assert np.average(shape.mean_curvatures, weights=metric.vertex_areas) == pytest.approx(1, rel=0.02)
    assert shape.asked_lengths.tolist() == metric.lengths.tolist()


def test_frames_turn_faces_into_space(sphere, shape):
    mesh, _, _ = sphere
    assert shape.frames.shape == (mesh.face_count, 4)
    np.testing.assert_allclose(np.linalg.norm(shape.frames, axis=1), 1, atol=1e-9)
    # The normal of a face is conj(q) i q.
    w, x, y, z = shape.frames.T
    normals = np.stack([w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)], axis=1)
    a, b, c = shape.positions[mesh.faces].transpose(1, 0, 2)
    outward = np.cross(b - a, c - a)
    outward /= np.linalg.norm(outward, axis=1)[:, None]
    assert np.mean(np.sum(normals * outward, axis=1)) > 0.999


@pytest.mark.parametrize("spin_class", ["01", "10"])
def test_flat_torus_of_a_class(flat_torus, spin_class):
    mesh, metric = flat_torus
    assert (mesh.genus, mesh.generators, mesh.euler_characteristic) == (1, 2, 0)
    shape = immerse.Immersion(metric, spin_class=spin_class, seed=0).relax()
    assert shape.spin_class == spin_class
    assert shape.report["l2_length_error"] < 0.02
    assert shape.report["asked_class"] == spin_class


BITS = """
import sys, immerse
mesh, positions = immerse.Mesh.shape("sphere", subdivisions=5)
metric = immerse.Metric.from_positions(mesh, positions)
shape = immerse.Immersion(metric, seed=3).relax()
sys.stdout.buffer.write(shape.positions.tobytes() + shape.frames.tobytes())
"""


def test_same_bits_on_any_number_of_threads():
    bits = [
        subprocess.run(
            [sys.executable, "-c", BITS], env={**os.environ, "RAYON_NUM_THREADS": threads}, capture_output=True, check=True
        ).stdout
        for threads in ("1", "3")
    ]
    assert len(bits[0]) > 1000 and bits[0] == bits[1]


def test_another_seed_gives_other_bits(sphere, shape):
    _, _, metric = sphere
    again = immerse.Immersion(metric, seed=0).relax()
    other = immerse.Immersion(metric, seed=1).relax()
    assert again.positions.tobytes() == shape.positions.tobytes()
    assert other.positions.tobytes() != shape.positions.tobytes()


def test_start_bending_and_pins(sphere):
    mesh, positions, metric = sphere
    near = immerse.Immersion(metric, start=positions).relax()
    assert np.abs(near.positions - positions).max() < 0.02, "it is laid upon what it starts from"
    bent = immerse.Immersion(metric, start=positions, bending=near.bending_angles).relax()
    assert bent.report["bending_error"]["rms_degrees"] < 1
    held = [0, 1]
    pinned = immerse.Immersion(metric, start=positions, pins=(held, positions[held])).relax()
    assert pinned.report["pin_distance"] < 0.02
    done = immerse.Immersion(metric, seed=0, accuracy=0.05).relax()
    assert done.report["l2_length_error"] <= 0.05
    assert done.report["steps"] < immerse.Immersion(metric, seed=0).relax().report["steps"]


def test_metric_of_what_was_found(shape):
    metric = shape.metric
    assert metric.lengths.tolist() == shape.lengths.tolist()
    assert metric.curvatures.sum() == pytest.approx(4 * np.pi)


def test_obj_goes_around(shape, tmp_path):
    shape.write_obj(tmp_path / "shape.obj")
    mesh, positions = immerse.Mesh.read(tmp_path / "shape.obj")
    assert mesh.faces.tolist() == shape.mesh.faces.tolist()
    np.testing.assert_allclose(positions, shape.positions, rtol=1e-12, atol=1e-15)
    with pytest.raises(FileNotFoundError, match="there is no folder"):
        shape.write_obj(tmp_path / "nowhere" / "shape.obj")
