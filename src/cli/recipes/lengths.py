"""Writes lengths.npz: triangles and the lengths of their sides, and nothing about where they lie in space.

A disk with any radius and any growth: at distance r from its middle, a circle is as long as 2 pi f(r). With f(r) = r it is flat,
with sin(r) a piece of a sphere, with sinh(r) hyperbolic. Change f, run this again, then the scene.
"""

import numpy

radius, rings = 2.0, 22
f = numpy.sinh

# Ring i has 6 i vertices; three triangles more in each of six sectors than in the ring before.
first = lambda i: numpy.where(i > 0, 1 + 3 * i * (i - 1), 0)  # the first vertex of ring i
vertex = lambda i, k: first(i) + k % numpy.maximum(6 * i, 1)
faces = []
for i in range(1, rings + 1):
    for sector in range(6):
        j = numpy.arange(i)
        inner, outer = sector * (i - 1) + j, sector * i + j
        faces.append(numpy.stack([vertex(i - 1, inner), vertex(i, outer), vertex(i, outer + 1)], axis=1))
        inner, outer = inner[:-1], outer[:-1]
        faces.append(numpy.stack([vertex(i - 1, inner), vertex(i, outer + 1), vertex(i - 1, inner + 1)], axis=1))
faces = numpy.concatenate(faces)

ring = numpy.concatenate([[0], numpy.repeat(numpy.arange(1, rings + 1), 6 * numpy.arange(1, rings + 1))])
place = numpy.arange(len(ring)) - first(ring)
r, angle = radius * ring / rings, 2 * numpy.pi * place / numpy.maximum(6 * ring, 1)

# Side k of a triangle runs from corner k to corner k + 1. It is as long as a straight line in a flat wedge that is as wide,
# halfway between the radii of its ends, as f says; the middle has no angle of its own.
u, v = faces, numpy.roll(faces, -1, axis=1)
turn = numpy.abs((angle[u] - angle[v] + numpy.pi) % (2 * numpy.pi) - numpy.pi)
turn[(u == 0) | (v == 0)] = 0
lengths = numpy.hypot(r[u] - r[v], f((r[u] + r[v]) / 2) * turn)

numpy.savez("lengths.npz", faces=faces, halfedge_lengths=lengths)
print(len(faces), "triangles in lengths.npz; now: immerse run numpy.toml")
