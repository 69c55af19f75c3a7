"""pygltflib and trimesh: buffers, morph targets and the animation of the .glb."""

import numpy
import pygltflib
import trimesh

from films import FILMS, Film, films, same, single

KINDS = {5125: "<u4", 5126: "<f4"}
SIDES = {"SCALAR": 1, "VEC3": 3}


def array(gltf, number):
    accessor = gltf.accessors[number]
    view = gltf.bufferViews[accessor.bufferView]
    start = (view.byteOffset or 0) + (accessor.byteOffset or 0)
    sides = SIDES[accessor.type]
    found = numpy.frombuffer(gltf.binary_blob(), KINDS[accessor.componentType], accessor.count * sides, start)
    found = found.reshape(accessor.count, sides) if sides > 1 else found
    if accessor.min:
        same(numpy.atleast_1d(found.min(axis=0)), accessor.min, "least values", 1e-6)
        same(numpy.atleast_1d(found.max(axis=0)), accessor.max, "largest values", 1e-6)
    return found


for name, film in {**films, "long": Film("long")}.items():
    path = film.exports / "film.glb"
    gltf = pygltflib.GLTF2().load(str(path))
    problems = pygltflib.validator.validate(gltf) if hasattr(pygltflib, "validator") else None
    assert not problems, problems
    mesh = gltf.meshes[0]
    primitive = mesh.primitives[0]
    base = array(gltf, primitive.attributes.POSITION)
    same(base, single(film.positions(1)), f"{name}: points of frame 1")
    same(array(gltf, primitive.indices).reshape(-1, 3), film.triangles, "faces")
    shown = [1 + k * (len(film) - 1) // 59 for k in range(60)] if len(film) > 60 else list(range(1, len(film) + 1))
    assert len(primitive.targets) == len(shown) - 1 == len(mesh.weights)
    for frame, target in zip(shown[1:], primitive.targets):
        moved = array(gltf, target["POSITION"] if isinstance(target, dict) else target.POSITION)
        same(base + moved, single(film.positions(frame)), f"{name}: points of frame {frame}", 1e-6)
    sampler = gltf.animations[0].samplers[0]
    times, weights = array(gltf, sampler.input), array(gltf, sampler.output)
    rate = 12 if name == "closed" else 24
    same(times, single(numpy.arange(len(shown)) / rate), "times", 1e-6)
    same(weights.reshape(len(shown), -1), numpy.eye(len(shown))[:, 1:], "weights")
    has_colors = primitive.attributes.COLOR_0 is not None
    assert has_colors == (name == "closed")
    if has_colors:
        colors = array(gltf, primitive.attributes.COLOR_0)
        assert colors.shape == base.shape and 0 <= colors.min() and colors.max() <= 1
    scene = trimesh.load(path)
    (geometry,) = scene.geometry.values()
    assert len(geometry.faces) == len(film.triangles)
    print(f"gltf: {name}: {len(shown)} of {len(film)} frames: as in the film")
