"""What is refused, in sentences that say what to do."""

import numpy as np
import pytest

import immerse

TETRAHEDRON = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]


def refusal(call):
    with pytest.raises(immerse.Error) as caught:
        call()
    error = caught.value
    assert isinstance(error, ValueError)
    text = str(error)
    assert error.remedy and error.remedy in text, "a sentence says what to do"
    return text


@pytest.mark.parametrize(
    "faces, words",
    [
        ([[0, 1, 2], [0, 1, 2]], "in the same direction; reverse one of them"),
        ([[0, 1, 1]], "two of them equal; remove the face"),
        ([[0, 1, 3]], "vertex 2 belongs to no face; remove it"),
        ([[0, 1, 2], [0, 3, 4]], "more than one fan; duplicate the vertex"),
        ([[0, 1, -2]], "faces has an entry -2"),
        ([[0, 1, 2**40]], "faces has an entry 1099511627776"),
        ([[0.0, 1.0, 2.0]], "faces is an array of type float64; give whole numbers"),
        ([[0, 1, 2, 3]], "faces has shape (1, 4); give one of shape (n, 3)"),
        ([0, 1, 2], "faces has shape (3,); give one of shape (n, 3)"),
        ([[0, 1], [2]], "faces is no array"),
        (np.zeros((0, 3), int), "no faces; give at least one triangle"),
    ],
)
def test_faces(faces, words):
    assert words in refusal(lambda: immerse.Mesh(faces))


@pytest.mark.parametrize(
    "lengths, words",
    [
        (np.ones(5), "the mesh has 6 edges, but 5 lengths were given; give one length per edge"),
        (np.ones((2, 2)), "lengths has shape (2, 2); give one per edge, (6,)"),
        ([1, 1, 1, 1, 1, np.nan], "has length NaN; every length must be positive and finite"),
        ([1, 1, 1, 1, 1, -1], "has length -1; every length must be positive and finite"),
        ([1, 1, 1, 1, 1, 3], "the triangle inequality fails in 2 faces"),
        (np.ones(6, complex), "lengths is an array of type complex128; give real numbers"),
        (["a"] * 6, "lengths is an array of type <U1; give real numbers"),
        (np.arange(1.0, 13.0).reshape(4, 3), "give both the same"),
        ([[0, 1, 1]] * 6, "row 1 of lengths names the edge between vertices 0 and 1 once more"),
        ([[0, 1, 1], [0, 9, 1]] + [[0, 1, 1]] * 4, "row 1 of lengths names vertices 0 and 9"),
    ],
)
def test_lengths(lengths, words):
    assert words in refusal(lambda: immerse.Metric(immerse.Mesh(TETRAHEDRON), lengths))


def test_positions():
    mesh = immerse.Mesh(TETRAHEDRON)
    assert "positions has shape (3, 3); give one of shape (4, 3)" in refusal(
        lambda: immerse.Metric.from_positions(mesh, np.zeros((3, 3)))
    )
    assert "has length 0" in refusal(lambda: immerse.Metric.from_positions(mesh, np.zeros((4, 3))))


def test_immersions(flat_torus):
    mesh, metric = flat_torus
    assert "give a Metric" in refusal(lambda: immerse.Immersion(mesh))
    assert "is no class" in refusal(lambda: immerse.Immersion(metric, spin_class="x"))
    assert "generator" in refusal(lambda: immerse.Immersion(metric, spin_class="0").relax())
    assert "start has shape" in refusal(lambda: immerse.Immersion(metric, start=np.zeros((2, 3))))
    lost = np.full((mesh.vertex_count, 3), np.nan)
    assert "coordinates must be finite" in refusal(lambda: immerse.Immersion(metric, start=lost).relax())
    assert "bending has an entry NaN" in refusal(
        lambda: immerse.Immersion(metric, bending=np.full(mesh.edge_count, np.nan))
    )
    assert "is pinned" in refusal(lambda: immerse.Immersion(metric, pins=([10**6], [[0, 0, 0]])))
    assert "places of pins has shape" in refusal(lambda: immerse.Immersion(metric, pins=([0, 1], [[0, 0, 0]])))
    assert "outward" in refusal(lambda: immerse.Immersion(metric, orientation="inward"))
    assert "the seed is -1" in refusal(lambda: immerse.Immersion(metric, seed=-1))
    assert "`Mesh(faces)` makes one" in refusal(lambda: immerse.Metric([[0, 1, 2]], [1, 1, 1]))
    assert "accuracy" in refusal(lambda: immerse.Immersion(metric, accuracy=-1))


def test_files(tmp_path):
    with pytest.raises(FileNotFoundError):
        immerse.Mesh.read(tmp_path / "none.obj")
    (tmp_path / "bad.obj").write_text("v 0 0 0\nv 1 0 zero\nf 1 2 3\n")
    assert "bad.obj:2:" in refusal(lambda: immerse.Mesh.read(tmp_path / "bad.obj"))
    (tmp_path / "mesh.xyz").write_text("")
    assert "no known mesh format" in refusal(lambda: immerse.Mesh.read(tmp_path / "mesh.xyz"))
    assert "did you mean" in refusal(lambda: immerse.Mesh.shape("spere"))
    assert "radius" in refusal(lambda: immerse.Mesh.shape("sphere", radius=-1))
