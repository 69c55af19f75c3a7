"""Pictures as arrays."""

import numpy as np
import pytest

import immerse


def test_a_picture_of_a_surface(shape):
    picture = immerse.render(shape, size=(120, 90), samples=4)
    assert picture.shape == (90, 120, 4) and picture.dtype == np.uint8 and picture.flags.c_contiguous
    background = picture[0, 0, :3].astype(int)
    shown = np.abs(picture[..., :3].astype(int) - background).sum(axis=-1) > 20
    rows, columns = np.nonzero(shown)
    assert 0.75 < np.ptp(rows) / 90 < 0.95, "the sphere fills what it is to fill"
    assert abs(rows.mean() - 45) < 6 and abs(columns.mean() - 60) < 6
    assert (picture == immerse.render(shape, size=(120, 90), samples=4)).all(), "the same each time"
    again = immerse.render(shape.mesh, shape.positions, size=(120, 90), samples=4)
    assert (picture == again).all()


def test_values_as_colour(sphere):
    mesh, positions, _ = sphere
    left_right = dict(size=(120, 90), direction=(0, -1, 0), up=(0, 0, 1), samples=4)
    picture = immerse.render(mesh, positions, color=positions[:, 0], color_map="diverging", **left_right)
    left, right = picture[40:50, 30:40, :3].mean(axis=(0, 1)), picture[40:50, 80:90, :3].mean(axis=(0, 1))
    assert left[2] > left[0] and right[0] > right[2], "blue is below 0, red above"
    per_face = immerse.render(mesh, positions, color=positions[mesh.faces].mean(axis=1)[:, 0], **left_right)
    assert per_face.shape == picture.shape


@pytest.mark.parametrize("look", ["studio", "clay", "soap", "blueprint"])
def test_looks_differ(shape, look):
    picture = immerse.render(shape, size=(80, 60), look=look, samples=4)
    assert np.ptp(picture[..., :3]) > 30
    if look != "studio":
        assert (picture != immerse.render(shape, size=(80, 60), samples=4)).any()


@pytest.mark.parametrize(
    "options, words",
    [
        ({"look": "velvet"}, "there is no look"),
        ({"look": "error"}, "shows fields of a film"),
        ({"size": (0, 10)}, "size"),
        ({"size": (-5, 10)}, "size"),
        ({"samples": 3}, "samples"),
        ({"direction": (0, 0, 0)}, "direction"),
        ({"direction": (0, 0, 1), "up": (0, 0, 2)}, "up"),
        ({"fill": 2.0}, "fill"),
        ({"color": [1.0, 2.0]}, "color has shape (2,)"),
        ({"color_map": "jet", "color": "ok"}, "there is no colour map"),
        ({"color": "nan"}, "color has an entry NaN"),
    ],
)
def test_refusals(shape, options, words):
    values = {"ok": np.zeros(shape.mesh.vertex_count), "nan": np.full(shape.mesh.vertex_count, np.nan)}
    options = {key: values.get(value, value) if isinstance(value, str) else value for key, value in options.items()}
    with pytest.raises(immerse.Error) as caught:
        immerse.render(shape, **options)
    assert words in str(caught.value)


def test_a_mesh_alone_cannot_be_seen(sphere):
    with pytest.raises(immerse.Error, match="a mesh alone has no positions"):
        immerse.render(sphere[0])
    with pytest.raises(immerse.Error, match="the surface is of type int"):
        immerse.render(3)
