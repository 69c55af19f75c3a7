"""Shape from metric: give a surface its edge lengths, get its shape; let the metric change, get the film.

The ten lines::

    import numpy as np
    import immerse

    mesh = immerse.Mesh(faces)                       # (n, 3) numbers of corners
    metric = immerse.Metric(mesh, lengths)           # one length per row of mesh.edges
    shape = immerse.Immersion(metric, spin_class="01", seed=0).relax()
    shape.positions                                  # (|V|, 3) float64
    shape.report["l2_length_error"]                  # what it is worth
    shape.write_obj("shape.obj")

What there is:

- ``Mesh``: connectivity, from faces, files or shapes by name.
- ``Metric``: edge lengths and what they determine: angles, areas, curvatures.
- ``Immersion``: a metric, a class and a seed; ``relax`` gives an ``ImmersedSurface``.
- ``ricci_flow``: from a metric to one of given curvatures, without any positions; a ``RicciFlow`` has it at all times.
- ``Film``: the frames of a scene file or dict, as an iterator of ``Frame``, in memory or in a folder.
- ``render``: a picture of a surface as an array.
- ``Progress``: what callbacks are given after every step.
- ``Error``: what was given is at fault; its text says what to do. ``Stopped``: a callback returned False.

Vertices, edges and faces count from 0. Lengths and positions have the same unit, whichever that is; angles are in
radians. Arrays that come out are read-only: copy one to change it. There are no global settings; the environment variable
RAYON_NUM_THREADS says how many threads are used, and results have the same bits on any number of them.
"""

from ._immerse import (
    Error,
    Film,
    Frame,
    Frames,
    ImmersedSurface,
    Immersion,
    Mesh,
    Metric,
    Progress,
    RicciFlow,
    Stopped,
    __version__,
    render,
    ricci_flow,
)

__all__ = [
    "Error",
    "Film",
    "Frame",
    "Frames",
    "ImmersedSurface",
    "Immersion",
    "Mesh",
    "Metric",
    "Progress",
    "RicciFlow",
    "Stopped",
    "__version__",
    "render",
    "ricci_flow",
]
