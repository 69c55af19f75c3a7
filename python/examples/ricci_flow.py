"""Ricci flow makes a dented metric round: how curvature evens out, and the surface at several times.

    python ricci_flow.py [PICTURE.png]

The flow knows lengths alone. Surfaces are found of its metrics, each from the one before.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import immerse

TIMES = (0.0, 0.03, 0.08, 0.16, 0.32, 1.0)


def main(path: str) -> None:
    mesh, sphere = immerse.Mesh.shape("sphere", subdivisions=10)
    assert sphere is not None
    x, y, z = sphere.T
    dented = sphere * (1 + 0.16 * np.sin(3.2 * x + 0.4) * np.cos(2.6 * y) + 0.12 * np.sin(3.4 * z))[:, None]
    flow = immerse.ricci_flow(immerse.Metric.from_positions(mesh, dented))

    # How far curvature is from constant, finely in time.
    finely = np.linspace(0.0, 2.0, 101)
    spread = [np.std(flow.at(time).gaussian_curvatures) for time in finely]

    places, shapes = dented, []
    for time in TIMES:
        metric = flow.at(time)
        shape = immerse.Immersion(metric, start=places).relax()
        print(f"time {time}: length error {100 * shape.report['l2_length_error']:.3f} %")
        shapes.append((time, metric.gaussian_curvatures, shape))
        places = shape.positions

    figure = plt.figure(figsize=(16, 8.6), facecolor="white")
    grid = figure.add_gridspec(2, 5, left=0.06, right=0.99, top=0.94, bottom=0.08, wspace=0.04, hspace=0.12)
    curve = figure.add_subplot(grid[:, :2])
    curve.semilogy(finely, spread, color="#2b6cb0", linewidth=2.2)
    curve.semilogy(TIMES, [np.std(curvature) for _, curvature, _ in shapes], "o", color="#c05621", markersize=7)
    curve.set_xlabel("time, in units of area / 4π", fontsize=12)
    curve.set_ylabel("standard deviation of Gaussian curvature", fontsize=12)
    curve.set_xlim(-0.02, 2)
    curve.grid(alpha=0.3, which="both")
    curve.spines[["top", "right"]].set_visible(False)

    # All in the same colours, as far from the curvature of the round sphere.
    bound = float(np.percentile(np.abs(shapes[0][1] - 1), 97))
    for k, (time, curvature, shape) in enumerate(shapes):
        tile = figure.add_subplot(grid[k // 3, 2 + k % 3])
        tile.imshow(
            immerse.render(
                shape, size=(660, 780), color=curvature - 1, color_map="diverging", color_range=(-bound, bound),
                direction=(0.5, -1.0, 0.45), up=(0, 0, 1),
            )
        )
        tile.set_title(f"t = {time:g}", fontsize=13)
        tile.set_axis_off()
    figure.savefig(path, dpi=100)
    print(path)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "ricci_flow.png")
