"""FOLD by its definition: arrays of the same edges, angles with the sign of a valley, frames that inherit."""

import json

import numpy

from films import films, same

for name, film in films.items():
    fold = json.loads((film.exports / "film.fold").read_text())
    assert fold["file_spec"] == 1.2
    frames = [fold, *fold.get("file_frames", [])]
    assert len(frames) == len(film)
    edges, faces = numpy.array(fold["edges_vertices"]), numpy.array(fold["faces_vertices"])
    same(faces, film.triangles, "faces")
    same(edges, film.edges(), "edges")
    sides = {}
    for f, corners in enumerate(faces.tolist()):
        for k in range(3):
            sides.setdefault(tuple(sorted((corners[k], corners[(k + 1) % 3]))), []).append(f)
    for number, frame in enumerate(frames, 1):
        assert number == 1 or (frame["frame_inherit"] and frame["frame_parent"] == 0)
        positions = numpy.array(frame["vertices_coords"])
        same(positions, film.positions(number), "positions")
        same(frame["edges_length"], film.frames[number - 1]["edge_lengths"], "lengths")
        for (u, v), angle, kind in zip(edges.tolist(), frame["edges_foldAngle"], frame["edges_assignment"]):
            both = sides[tuple(sorted((u, v)))]
            if len(both) == 1:
                assert kind == "B" and angle == 0
                continue
            normals, middles = [], []
            for f in both:
                a, b, c = positions[faces[f]]
                normals.append(numpy.cross(b - a, c - a) / numpy.linalg.norm(numpy.cross(b - a, c - a)))
                middles.append((a + b + c) / 3)
            wanted = numpy.degrees(numpy.arccos(numpy.clip(numpy.dot(*normals), -1, 1)))
            # Where the neighbour rises above the front of a face there is a valley.
            rises = numpy.dot(middles[1] - middles[0], normals[0]) > 0
            assert abs(angle - (wanted if rises else -wanted)) < 1e-5, (angle, wanted, rises)
            assert kind == ("F" if abs(angle) < 1e-6 else "V" if angle > 0 else "M")
    print(f"fold: {name}: {len(frames)} frames: as in the film")
