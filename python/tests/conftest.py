"""What several tests start from."""

import numpy as np
import pytest

import immerse


@pytest.fixture(scope="session")
def sphere():
    """A sphere: mesh, positions, metric."""
    mesh, positions = immerse.Mesh.shape("sphere", subdivisions=6)
    return mesh, positions, immerse.Metric.from_positions(mesh, positions)


@pytest.fixture(scope="session")
def flat_torus():
    """A rectangle of 5 by 3 with opposite sides glued, which has no positions: mesh, metric."""
    across, along = 30, 18
    u, v = (grid.ravel() for grid in np.meshgrid(np.arange(across), np.arange(along)))

    def vertex(u, v):
        return u % across + v % along * across

    a, b, c, d = vertex(u, v), vertex(u + 1, v), vertex(u + 1, v + 1), vertex(u, v + 1)
    mesh = immerse.Mesh(np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]))
    p, q = mesh.edges.astype(int).T
    du = np.where(p % across != q % across, 5 / across, 0.0)
    dv = np.where(p // across != q // across, 3 / along, 0.0)
    return mesh, immerse.Metric(mesh, np.hypot(du, dv))


@pytest.fixture(scope="session")
def shape(sphere):
    """The sphere again, from its lengths alone."""
    _, _, metric = sphere
    return immerse.Immersion(metric, seed=0).relax()
