"""Films from scenes, texts and dicts, in memory and on disk, and their pictures."""

import os
import pathlib
import shutil
import subprocess

import numpy as np
import pytest
from PIL import Image

import immerse

SCENE = {
    "mesh": {"shape": "torus", "major_radius": 1, "minor_radius": 0.4, "columns": 24, "rows": 10},
    "start": {"from": "mesh"},
    "metric": {"change": [{"kind": "conformal", "log_scale": "0.3 * x * sin(2 * PI * t)"}]},
    "clock": {"frames": 4, "loop": True},
    "camera": {"direction": np.array([0.3, -1.0, 0.8])},
    "output": {"size": np.array([160, 120])},
}
TEXT = """
[mesh]
shape = "torus"
major_radius = 1
minor_radius = 0.4
columns = 24
rows = 10
[start]
from = "mesh"
[[metric.change]]
kind = "conformal"
log_scale = "0.3 * x * sin(2 * PI * t)"
[clock]
frames = 4
loop = true
[camera]
direction = [0.3, -1.0, 0.8]
[output]
size = [160, 120]
"""


def program():
    """The program, if it is built."""
    folder = os.environ.get("CARGO_TARGET_DIR") or pathlib.Path(__file__).parents[2] / "target"
    path = pathlib.Path(folder) / "release" / "immerse"
    return path if path.exists() else None


def test_an_iterator_of_frames():
    film = immerse.Film(SCENE)
    assert len(film) == 4
    np.testing.assert_allclose(film.times, [0, 0.25, 0.5, 0.75])
    frames = list(film)
    assert [frame.number for frame in frames] == [1, 2, 3, 4]
    assert [frame.time for frame in frames] == film.times.tolist()
    for frame in frames:
        assert isinstance(frame, immerse.ImmersedSurface)
        assert frame.positions.shape == (film.mesh.vertex_count, 3)
        assert frame.report["l2_length_error"] < 0.01 and frame.spin_class == "00"
    assert not np.allclose(frames[0].asked_lengths, frames[1].asked_lengths)
    again = list(film)
    assert [frame.positions.tobytes() for frame in again] == [frame.positions.tobytes() for frame in frames]


def test_dict_text_and_file_are_one(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(TEXT)
    films = [immerse.Film(SCENE), immerse.Film(TEXT), immerse.Film(path), immerse.Film(str(path))]
    bits = [next(iter(film)).positions.tobytes() for film in films]
    assert len(set(bits)) == 1


def test_progress_and_stopping(tmp_path):
    film = immerse.Film(SCENE, folder=tmp_path / "film")
    seen = []

    def in_third_frame(progress):
        seen.append((progress.frame, progress.frames))
        return progress.frame < 3

    frames = film.frames(progress=in_third_frame)
    assert next(frames).number == 1 and next(frames).number == 2
    with pytest.raises(immerse.Stopped):
        next(frames)
    del frames
    assert {frames for _, frames in seen} == {4}
    whole = [frame.positions.tobytes() for frame in immerse.Film(SCENE, folder=tmp_path / "film")]
    assert whole == [frame.positions.tobytes() for frame in immerse.Film(SCENE)], "it goes on to the same bits"


def test_a_film_on_disk(tmp_path):
    folder = tmp_path / "film"
    film = immerse.Film(SCENE, folder=folder)
    bits = [frame.positions.tobytes() for frame in film]
    calls = []
    assert [frame.positions.tobytes() for frame in film.frames(progress=calls.append)] == bits
    assert calls == [], "nothing is computed again"
    (folder / "frames" / "000003.npz").write_bytes(b"damaged")
    assert [frame.positions.tobytes() for frame in film.frames(progress=calls.append)] == bits
    assert {call.frame for call in calls} == {3}, "what is damaged is made again"
    opened = immerse.Film.open(folder)
    assert len(opened) == 4 and opened.times.tolist() == film.times.tolist()
    assert [frame.positions.tobytes() for frame in opened] == bits
    third = opened.read(3)
    assert third.number == 3 and third.positions.tobytes() == bits[2]
    stored = np.load(folder / "frames" / "000003.npz")
    assert stored["positions"].tobytes() == bits[2]
    assert stored["face_frames"].tobytes() == third.frames.tobytes()
    assert stored["edge_lengths"].tobytes() == third.asked_lengths.tobytes()
    assert np.flatnonzero(stored["rims"]).tolist() == third.rims.tolist()
    assert np.load(folder / "mesh.npz")["triangles"].tolist() == film.mesh.faces.tolist()


def test_pictures_are_those_that_are_written(tmp_path):
    film = immerse.Film(SCENE, folder=tmp_path / "film")
    picture = film.picture(2)
    assert picture.shape == (120, 160, 4) and picture.dtype == np.uint8 and (picture[..., 3] == 255).all()
    assert not (tmp_path / "film" / "000002.png").exists(), "an array alone writes no file"
    film.make_pictures()
    for number in (1, 2, 3, 4):
        written = np.asarray(Image.open(tmp_path / "film" / f"{number:06}.png").convert("RGB"))
        assert (film.picture(number)[..., :3] == written).all()
    assert (immerse.Film.open(tmp_path / "film").picture(2) == picture).all(), "the folder keeps its scene"
    assert np.ptp(picture[..., :3]) > 100, "something is to be seen"


def test_same_bits_as_the_program(tmp_path):
    if program() is None:
        pytest.skip("SKIPPED: the program is not built; `cargo build --release --locked` builds it")
    path = tmp_path / "scene.toml"
    path.write_text(TEXT)
    done = subprocess.run([program(), "run", path, "--out", tmp_path / "theirs"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    film = immerse.Film(path, folder=tmp_path / "ours")
    film.make_pictures()
    kinds = ("*.npz", "*.json", "*.png", "scene.toml")
    theirs = [file for kind in kinds for file in sorted((tmp_path / "theirs").rglob(kind))]
    assert len(theirs) >= 5 + 5 + 4 + 1
    for file in theirs:
        own = tmp_path / "ours" / file.relative_to(tmp_path / "theirs")
        assert own.read_bytes() == file.read_bytes(), file.name


def refusal(call):
    with pytest.raises(immerse.Error) as caught:
        call()
    return str(caught.value)


def test_mistakes_have_places_carets_and_remedies():
    text = refusal(lambda: immerse.Film({"mesh": {"shape": "spere"}}))
    assert "did you mean `sphere`?" in text
    lines = text.splitlines()
    assert lines[1].endswith('shape = "spere"')
    assert lines[2].index("^") == lines[1].index('"spere"'), text
    both = refusal(lambda: immerse.Film('[mesh]\nshape = "sphere"\nradius = "one"\n[clock]\nframes = -1\n'))
    assert "scene.toml:3:" in both and "scene.toml:5:" in both, "all mistakes at once"
    assert "not TOML" in refusal(lambda: immerse.Film("[mesh\nshape = 1"))


def test_what_is_no_scene(tmp_path):
    with pytest.raises(FileNotFoundError, match="there is no such file"):
        immerse.Film(tmp_path / "none.toml")
    assert "the scene is of type int; give a path" in refusal(lambda: immerse.Film(3))
    assert "`mesh.radius` is of type NoneType" in refusal(lambda: immerse.Film({"mesh": {"shape": "sphere", "radius": None}}))
    assert "keys of a scene are strings" in refusal(lambda: immerse.Film({"mesh": {1: 2}}))
    with pytest.raises(FileNotFoundError):
        immerse.Film.open(tmp_path / "none")
    film = immerse.Film(SCENE)
    assert "has no folder" in refusal(lambda: film.picture(1))
    assert "counted from 1" in refusal(lambda: immerse.Film(SCENE, folder=tmp_path / "f").picture(-1))
    assert "counted from 1" in refusal(lambda: immerse.Film(SCENE, folder=tmp_path / "f").read(0))
    film = immerse.Film(SCENE, folder=tmp_path / "film")
    list(film)
    (tmp_path / "film" / ".immerse" / "scene.toml").unlink()
    assert "does not hold its scene" in refusal(lambda: immerse.Film.open(tmp_path / "film").picture(1))
    other = {**SCENE, "mesh": {"shape": "sphere", "subdivisions": 4}, "metric": {}}
    shutil.copytree(tmp_path / "film", tmp_path / "copy")
    assert len(list(immerse.Film({**other, "clock": {"frames": 1}}, folder=tmp_path / "copy"))) == 1


def test_a_mistake_that_time_brings():
    late = {**SCENE, "metric": {"change": [{"kind": "conformal", "log_scale": "1 / (0.5 - t)"}]}}
    frames = iter(immerse.Film(late))
    text = refusal(lambda: [frame.number for frame in frames])
    assert "0.5" in text and "formula" in text
