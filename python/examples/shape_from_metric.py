"""A metric that is written down in NumPy, its shape, and two pictures of it: Matplotlib's and our own.

    python shape_from_metric.py [PICTURE.png]

Nobody has seen this surface: it is a sphere whose lengths are stretched by a function on it, and only the lengths are
given. What comes back is as NumPy arrays again.
"""

import sys
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib import colormaps
from matplotlib.colors import Normalize

import immerse

MAP = "viridis"


def main(path: str) -> None:
    mesh, sphere = immerse.Mesh.shape("sphere", subdivisions=24)
    assert sphere is not None

    # Lengths are multiplied by exp of the mean of u at their ends. Curvature stays positive, so that there is one such
    # surface and it is convex (Alexandrov's theorem): six corners, and four faces of eight that bulge more.
    x, y, z = sphere.T
    u = 0.11 * (x**4 + y**4 + z**4 - 0.6) + 0.16 * x * y * z
    a, b = mesh.edges.T
    lengths = np.linalg.norm(sphere[a] - sphere[b], axis=1) * np.exp((u[a] + u[b]) / 2)

    metric = immerse.Metric(mesh, lengths)
    shape = immerse.Immersion(metric, seed=0).relax()
    report = shape.report
    print(f"length error {100 * report['l2_length_error']:.3f} %, {report['rims']} rims, {report['seconds']:.1f} s")

    # Back in NumPy: curvature of what was asked for, and where the vertices came to be.
    curvature = metric.gaussian_curvatures
    low, high = 0.0, float(curvature.max())
    view = np.array([1.0, -1.3, 0.9])
    figure = plt.figure(figsize=(16, 7.4), facecolor="white")
    colors = colormaps[MAP](Normalize(low, high)(curvature[mesh.faces].mean(axis=1)))
    p, q, r = shape.positions[mesh.faces].transpose(1, 0, 2)
    normals = np.cross(q - p, r - p)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    light = np.array([0.9, -0.5, 1.2]) / np.linalg.norm([0.9, -0.5, 1.2])
    colors[:, :3] *= (0.72 + 0.28 * np.clip(normals @ light, -0.6, 1))[:, None]

    left: Any = figure.add_axes((0.0, 0.08, 0.46, 0.8), projection="3d")
    elevation = np.degrees(np.arctan2(view[2], np.hypot(view[0], view[1])))
    left.view_init(elev=elevation, azim=np.degrees(np.arctan2(view[1], view[0])))
    surface = left.plot_trisurf(*shape.positions.T, triangles=mesh.faces.astype(int), linewidth=0, antialiased=False)
    surface.set_facecolor(colors)
    surface.set_edgecolor(colors)
    reach = 0.66 * np.abs(shape.positions - shape.positions.mean(axis=0)).max()
    for set_limits, middle in zip((left.set_xlim, left.set_ylim, left.set_zlim), shape.positions.mean(axis=0)):
        set_limits(middle - reach, middle + reach)
    left.set_box_aspect((1, 1, 1))
    left.set_axis_off()
    figure.text(0.23, 0.92, "Matplotlib", ha="center", fontsize=15)

    right = figure.add_axes((0.46, 0.08, 0.44, 0.8))
    picture = immerse.render(
        shape, size=(1320, 1110), color=curvature, color_map=MAP, color_range=(low, high),
        direction=view, up=np.array([0.0, 0.0, 1.0]),
    )
    right.imshow(picture)
    right.set_axis_off()
    figure.text(0.68, 0.92, "immerse.render", ha="center", fontsize=15)

    bar = figure.add_axes((0.925, 0.2, 0.012, 0.56))
    figure.colorbar(
        plt.cm.ScalarMappable(Normalize(low, high), MAP), cax=bar, label="Gaussian curvature of the metric"
    )
    figure.savefig(path, dpi=100)
    print(path)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "shape_from_metric.png")
