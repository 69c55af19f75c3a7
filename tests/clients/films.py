"""The films that the program has made, as NumPy reads them, to compare with what other programs read."""

import sys
from pathlib import Path

import numpy

FILMS = Path(sys.argv[1])


class Film:
    def __init__(self, name):
        self.folder = FILMS / name
        self.exports = self.folder / "export"
        self.mesh = numpy.load(self.folder / "mesh.npz")
        files = sorted((self.folder / "frames").glob("*.npz"))
        self.frames = [numpy.load(file) for file in files]
        self.triangles = self.mesh["triangles"]

    def __len__(self):
        return len(self.frames)

    def positions(self, frame):
        """Of a frame, counted from 1; |V| x 3."""
        return self.frames[frame - 1]["positions"]

    def fields(self, frame):
        """All fields, from the export as npz."""
        return numpy.load(self.exports / f"film.{frame:06}.npz")

    def edges(self):
        return self.fields(1)["edges"]

    def length_error(self, frame):
        """Of each face, root mean square over its edges, computed anew."""
        edges, lengths = self.edges(), self.frames[frame - 1]["edge_lengths"]
        start, end = self.positions(frame)[edges.T]
        error = numpy.linalg.norm(end - start, axis=1) / lengths - 1
        of = {tuple(sorted(pair)): value for pair, value in zip(edges.tolist(), error)}
        corners = self.triangles.tolist()
        sides = [[of[tuple(sorted((f[k], f[(k + 1) % 3])))] for k in range(3)] for f in corners]
        return numpy.sqrt(numpy.mean(numpy.square(sides), axis=1))


def same(found, wanted, what, tolerance=0.0):
    """Fails unless two arrays are the same, up to a share of the largest."""
    found, wanted = numpy.asarray(found), numpy.asarray(wanted)
    assert found.shape == wanted.shape, f"{what}: {found.shape} instead of {wanted.shape}"
    far = numpy.abs(found.astype(float) - wanted.astype(float)).max() if found.size else 0.0
    most = tolerance * max(1.0, numpy.abs(wanted).max() if wanted.size else 0.0)
    assert far <= most, f"{what}: off by {far}"


def single(array):
    return numpy.asarray(array, dtype=numpy.float32)


films = {name: Film(name) for name in ("closed", "parts")}
