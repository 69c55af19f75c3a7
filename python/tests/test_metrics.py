"""Meshes and metrics against closed forms, and Ricci flow."""

import numpy as np
import pytest

import immerse

TETRAHEDRON = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]


def test_counts_and_edges():
    mesh = immerse.Mesh(TETRAHEDRON)
    assert (mesh.vertex_count, mesh.edge_count, mesh.face_count) == (4, 6, 4)
    assert (mesh.euler_characteristic, mesh.genus, mesh.components, mesh.boundary_loops) == (2, 0, 1, 0)
    assert sorted(map(sorted, mesh.edges.tolist())) == [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]]
    for face, edges in zip(mesh.faces, mesh.face_edges):
        for k in range(3):
            assert set(mesh.edges[edges[k]]) == {face[k], face[(k + 1) % 3]}
    strip = immerse.Mesh([[0, 1, 2], [2, 1, 3]])
    assert strip.boundary_loops == 1 and strip.on_boundary.all()


@pytest.mark.parametrize("dtype", ["int64", "int32", "uint32", "uint64", "uint8"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_faces_of_any_whole_type_and_order(dtype, order):
    mesh = immerse.Mesh(np.array(TETRAHEDRON, dtype=dtype, order=order))
    assert mesh.faces.tolist() == TETRAHEDRON


def test_regular_tetrahedron():
    mesh = immerse.Mesh(TETRAHEDRON)
    metric = immerse.Metric(mesh, np.ones(6))
    np.testing.assert_allclose(metric.angles, np.pi / 3)
    np.testing.assert_allclose(metric.areas, np.sqrt(3) / 4)
    np.testing.assert_allclose(metric.curvatures, np.pi)
    np.testing.assert_allclose(metric.vertex_areas, np.sqrt(3) / 4)
    np.testing.assert_allclose(metric.gaussian_curvatures, np.pi / (np.sqrt(3) / 4))


def test_lengths_in_every_form(sphere):
    mesh, positions, metric = sphere
    lengths = metric.lengths
    per_side = lengths[mesh.face_edges]
    rows = np.column_stack([mesh.edges[::-1, ::-1], lengths[::-1]])
    by_function = immerse.Metric.from_function(
        mesh, lambda a, b: np.linalg.norm(positions[a] - positions[b], axis=1)
    )
    for other in (immerse.Metric(mesh, per_side), immerse.Metric(mesh, rows), immerse.Metric(mesh, lengths.tolist())):
        assert other.lengths.tolist() == lengths.tolist()
    np.testing.assert_allclose(by_function.lengths, lengths, rtol=1e-14)
    assert metric.curvatures.sum() == pytest.approx(4 * np.pi)


def test_ricci_flow_makes_round(sphere):
    mesh, positions, _ = sphere
    dented = positions * (1 + 0.2 * np.sin(5 * positions[:, :1]))
    start = immerse.Metric.from_positions(mesh, dented)
    flow = immerse.ricci_flow(start)
    spread = [np.std(flow.at(time).gaussian_curvatures) for time in (0.0, 1.0, 3.0)]
    assert spread[0] > 3 * spread[1] > 9 * spread[2]
    assert flow.at(0.0).lengths.tolist() == pytest.approx(start.lengths.tolist())
    limit = flow.limit
    assert flow.curvature_error(limit) < 1e-8
    assert np.ptp(limit.gaussian_curvatures) < 1e-6
    assert limit.areas.sum() == pytest.approx(start.areas.sum())
    scale = flow.log_scale_at(1.0)
    a, b = mesh.edges.T
    np.testing.assert_allclose(flow.at(1.0).lengths, start.lengths * np.exp((scale[a] + scale[b]) / 2), rtol=1e-9)
    back = flow.at(0.5)
    assert back.lengths.tolist() == immerse.ricci_flow(start).at(0.5).lengths.tolist(), "in any order"


def test_ricci_flow_to_given_curvatures(sphere):
    mesh, _, metric = sphere
    target = np.full(mesh.vertex_count, 4 * np.pi / mesh.vertex_count)
    np.testing.assert_allclose(immerse.ricci_flow(metric, target).limit.curvatures, target, atol=1e-8)
    with pytest.raises(immerse.Error, match="Gauss-Bonnet"):
        immerse.ricci_flow(metric, target * 2)
    with pytest.raises(immerse.Error, match="Gauss-Bonnet"):
        immerse.ricci_flow(metric, -1.0)
