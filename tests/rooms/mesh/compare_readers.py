"""Compares immerse's readers with those of trimesh and meshio.

    compare_readers.py FOLDER READ

FOLDER holds meshes; READ is a JSON file of what immerse says of each of them: the number of places at which there are
vertices, the number of triangles and their area, or an error. compare_readers.rs writes it and runs this.
Exit code 1 if one of the others says something else.
"""

import json
import sys
from pathlib import Path

import meshio
import numpy
import trimesh

# Files that one of the others cannot read, or reads as something else: concave polygons as fans, homogeneous
# coordinates as plain ones. There it is asked for a twin, the same surface written as plainly as can be.
TWINS = {
    "l_prism_triangles.obj": ["l_prism.obj", "l_prism.off", "l_prism.ply", "l_prism_binary.ply"],
    "keyhole_quads.obj": ["keyhole.obj"],
    "square.obj": ["continued.obj", "repeated_corner.obj"],
    "strips_triangles.obj": ["strips.ply"],
    "tetrahedron.obj": [
        *("exponents.obj", "indices.obj", "mark.obj", "old_mac.obj", "upper_case.obj", "utf16_little.obj"),
        *("counts_in_header.off", "headless.off", "lower_case.off", "mark.off", "ncoff.off", "old_mac.off", "st4.off"),
        *("utf16_big.off", "mark.ply", "old_mac.ply", "other_elements.ply", "big_endian.ply", "uint64.ply", "utf16.ply"),
        *("old_mac.stl", "spaced_end.stl", "trailing.stl", "upper_case.stl", "utf16.stl"),
    ],
}
TWIN_OF = {f"readers/{name}": f"readers/{twin}" for twin, names in TWINS.items() for name in names}


def summary(points, polygons):
    """Places, triangles and area of polygons that are lists of point numbers."""
    used = sorted({v for polygon in polygons for v in polygon})
    places = len({tuple(points[v]) for v in used})
    triangles = sum(len(polygon) - 2 for polygon in polygons)
    area = 0.0
    for polygon in polygons:
        p = points[polygon] - points[polygon[0]]
        area += 0.5 * numpy.linalg.norm(numpy.cross(p, numpy.roll(p, -1, axis=0)).sum(axis=0))
    return {"vertices": places, "faces": triangles, "area": area}


def by_trimesh(path):
    mesh = trimesh.load(path, force="mesh", process=False)
    return summary(numpy.array(mesh.vertices), [list(face) for face in mesh.faces])


def by_meshio(path):
    mesh = meshio.read(path)
    points = numpy.array(mesh.points, dtype=float)
    flat = ("triangle", "quad", "polygon")
    polygons = [list(face) for block in mesh.cells if block.type.startswith(flat) for face in block.data]
    return summary(points, polygons)


def same(a, b):
    counts = all(a[key] == b[key] for key in ("vertices", "faces"))
    return counts and abs(a["area"] - b["area"]) <= 1e-6 * abs(b["area"])


def reading(read, path):
    """What a reader says of a file, and in words if it says nothing."""
    try:
        other = read(path)
        return (other, str(other)) if other["faces"] else (None, "finds no faces")
    except (Exception, SystemExit) as error:  # meshio ends the program where it cannot read
        return None, f"cannot read it, {error!r}"[:110]


def compare(folder, ours):
    wrong, alone = 0, []
    agreed = {"trimesh": [0, 0], "meshio": [0, 0]}
    for name, own in sorted(ours.items()):
        compared = False
        for reader, read in (("trimesh", by_trimesh), ("meshio", by_meshio)):
            other, said = reading(read, folder / name)
            if "error" in own:
                print(f"{name}: {reader}: {said}; immerse: {own['error']}")
                continue
            twin = TWIN_OF.get(name)
            is_twin = twin is not None and (other is None or not same(own, other))
            if is_twin:
                print(f"{name}: {reader}: {said}; asked for {twin}")
                other, said = reading(read, folder / twin)
            if other is None:
                print(f"{name}: {reader}: {said}")
            elif same(own, other):
                agreed[reader][is_twin] += 1
                compared = True
            else:
                wrong += 1
                print(f"DIFFERENT {name}: {reader}: {said}; immerse: {own}")
        if not compared and "error" not in own:
            alone.append(name)
    for reader, (plain, twins) in agreed.items():
        print(f"{reader} agrees on {plain} of {len(ours)} files, and on the twins of {twins}")
    if alone:
        print("NOT COMPARED, since neither reads them:", *alone)
    return wrong == 0 and all(plain > 10 for plain, _ in agreed.values())


if __name__ == "__main__":
    folder, read = map(Path, sys.argv[1:])
    sys.exit(0 if compare(folder, json.loads(read.read_text())) else 1)
