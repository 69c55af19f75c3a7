"""Blender: the stage, and the point cache on its object, have the vertices of the film; colours are there."""

import sys
from pathlib import Path

import bpy
import numpy

from films import films, same, single


def places(thing, frame):
    """Of an object as it is shown at a frame, in the world."""
    bpy.context.scene.frame_set(frame)
    shown = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    points = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
    mesh.vertices.foreach_get("co", points)
    matrix = numpy.array(shown.matrix_world)
    return points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def is_turned(stage_up):
    """Blender's z is up; it turns what has y up."""
    return stage_up == "Y"


for name, film in films.items():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    path = film.exports / "film.usda"
    bpy.ops.wm.usd_import(filepath=str(path), import_subdivision=False)
    up = "Y" if 'upAxis = "Y"' in path.read_text()[:500] else "Z"
    turn = numpy.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]) if is_turned(up) else numpy.eye(3)
    surface = next(thing for thing in bpy.data.objects if thing.type == "MESH" and thing.name.startswith("surface"))
    for frame in (1, len(film)):
        same(places(surface, frame), film.positions(frame) @ turn.T, f"{name}: stage, frame {frame}", 2e-6)
    names = {attribute.name for attribute in surface.data.attributes}
    assert {"displayColor", "length_error", "mean_curvature"} <= names, names
    assert any(thing.type == "CAMERA" for thing in bpy.data.objects)
    assert sum(thing.type == "LIGHT" for thing in bpy.data.objects) >= 2

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.obj_import(filepath=str(film.exports / "film.obj"), forward_axis="Y", up_axis="Z")
    thing = bpy.context.selected_objects[0]
    cache = thing.modifiers.new("film", "MESH_CACHE")
    cache.cache_format, cache.filepath = "PC2", str(film.exports / "film.pc2")
    cache.frame_start = 1
    for frame in (1, len(film)):
        same(places(thing, frame), single(film.positions(frame)), f"{name}: point cache, frame {frame}", 2e-6)
    print(f"blender {bpy.app.version_string}: {name}: stage and point cache as in the film")
