"""PC2 by its definition, PLY by plyfile and trimesh, OBJ by meshio."""

import struct

import meshio
import numpy
import plyfile
import trimesh

from films import films, same, single

for name, film in films.items():
    data = (film.exports / "film.pc2").read_bytes()
    magic, version, points, start, rate, samples = struct.unpack("<12siiffi", data[:32])
    assert (magic, version, start, rate) == (b"POINTCACHE2\0", 1, 1, 1)
    cache = numpy.frombuffer(data, "<f4", offset=32).reshape(samples, points, 3)
    same(cache, numpy.array([single(film.positions(k + 1)) for k in range(len(film))]), "point cache")
    base = trimesh.load(film.exports / "film.obj", process=False, maintain_order=True, group_material=False)
    if isinstance(base, trimesh.Trimesh):
        same(base.vertices, film.positions(1), "the object of the point cache")
    for frame in range(1, len(film) + 1):
        mesh = meshio.read(film.exports / f"film.{frame:06}.obj")
        same(mesh.points, film.positions(frame), f"{name}: obj of frame {frame}")
        faces = numpy.concatenate([cells.data for cells in mesh.cells if cells.type == "triangle"])
        same(faces, film.triangles, "faces")
        path = film.exports / f"film.{frame:06}.ply"
        ply = plyfile.PlyData.read(path)
        vertices, faces = ply["vertex"], ply["face"]
        same(numpy.stack([vertices[axis] for axis in "xyz"], axis=1), film.positions(frame), f"{name}: ply of frame {frame}")
        same(numpy.stack(faces["vertex_indices"]), film.triangles, "faces")
        fields = film.fields(frame)
        same(numpy.stack([vertices["n" + axis] for axis in "xyz"], axis=1), fields["normals"], "normals")
        for field in ("gaussian_curvature", "mean_curvature", "conformal_factor"):
            same(vertices[field], fields[field], field)
        for field in ("length_error", "energy_density", "bending_angle", "generators"):
            same(faces[field], fields[field], field)
        by_trimesh = trimesh.load(path, process=False)
        assert by_trimesh.visual.kind == "vertex", "colours"
        same(by_trimesh.vertices, film.positions(frame), "trimesh", 1e-12)
    print(f"pc2, ply, obj: {name}: as in the film")
