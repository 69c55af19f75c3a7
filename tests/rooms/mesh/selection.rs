//! Vertices and edges that a scene selects.

use glam::DVec3;
use immerse::mesh::{EdgeId, Mesh, SelectionError, Surface, VertexId, select_edges, select_vertices, shapes};
use immerse::mesh::{EdgeSelection, Selection as Select};

fn indices(vertices: &[VertexId]) -> Vec<usize> {
    vertices.iter().map(|v| v.index()).collect()
}

fn vertices(section: &Select, surface: &Surface) -> Result<Vec<usize>, SelectionError> {
    select_vertices(section, &surface.mesh, surface.places()).map(|found| indices(&found))
}

fn edges(section: &EdgeSelection, surface: &Surface) -> Result<Vec<EdgeId>, SelectionError> {
    select_edges(section, &surface.mesh, surface.places())
}

/// An annulus in the plane z = 0: two boundary loops.
fn annulus() -> Surface {
    shapes::annulus(0.5, 1.0, 24, 6).expect("an annulus")
}

/// The vertices of which this holds, by a walk over all of them.
fn those(surface: &Surface, holds: impl Fn(DVec3) -> bool) -> Vec<usize> {
    let positions = surface.positions.as_ref().expect("positions");
    (0..positions.len()).filter(|&v| holds(positions[v])).collect()
}

#[test]
fn by_index_in_the_order_of_the_list() {
    let surface = annulus();
    assert_eq!(vertices(&Select::Vertices(vec![7, 0, 3]), &surface), Ok(vec![7, 0, 3]));
    let last = surface.mesh.vertex_count() - 1;
    assert_eq!(vertices(&Select::Vertices(vec![last]), &surface), Ok(vec![last]));
    let beyond = SelectionError::NoSuchVertex { vertex: last + 1, vertices: last + 1 };
    assert_eq!(vertices(&Select::Vertices(vec![0, last + 1]), &surface), Err(beyond.clone()));
    assert!(beyond.to_string().ends_with(&format!("use indices below {}", last + 1)), "{beyond}");
    assert_eq!(vertices(&Select::Vertices(Vec::new()), &surface), Err(SelectionError::Nothing));
}

#[test]
fn by_boundary_loop() {
    let surface = annulus();
    let inner = those(&surface, |p| p.length() < 0.5 + 1e-9);
    let outer = those(&surface, |p| p.length() > 1.0 - 1e-9);
    let found = [0, 1].map(|k| vertices(&Select::Boundary(vec![k]), &surface).expect("a loop"));
    assert!(found == [inner.clone(), outer.clone()] || found == [outer.clone(), inner.clone()]);
    // They are counted as `boundary_loops` lists them.
    for (k, cycle) in surface.mesh.boundary_loops().iter().enumerate() {
        assert!(cycle.iter().all(|&h| found[k].contains(&surface.mesh.tail(h).index())));
        assert_eq!(cycle.len(), found[k].len());
    }
    let mut both: Vec<usize> = inner.into_iter().chain(outer).collect();
    both.sort_unstable();
    assert_eq!(vertices(&Select::Boundary(vec![1, 0]), &surface), Ok(both));
    assert_eq!(
        vertices(&Select::Boundary(vec![0, 2]), &surface),
        Err(SelectionError::NoSuchLoop { loop_index: 2, loops: 2 })
    );
    let closed = shapes::sphere(1.0, 2).expect("a sphere");
    assert_eq!(
        vertices(&Select::Boundary(vec![0]), &closed),
        Err(SelectionError::NoSuchLoop { loop_index: 0, loops: 0 })
    );
    // Needs no positions.
    assert_eq!(
        select_vertices(&Select::Boundary(vec![0]), &surface.mesh, None).map(|v| indices(&v)),
        Ok(found[0].clone())
    );
}

#[test]
fn by_box_and_ball_with_their_surfaces() {
    let surface = shapes::sphere(2.0, 6).expect("a sphere");
    let positions = surface.positions.clone().expect("positions");
    let upper = those(&surface, |p| p.z >= 0.0);
    assert!(upper.len() > positions.len() / 2, "some lie on the equator");
    for corners in [[[-2.0, -2.0, 0.0], [2.0, 2.0, 2.0]], [[2.0, -2.0, 2.0], [-2.0, 2.0, 0.0]]] {
        assert_eq!(vertices(&Select::Box(corners), &surface), Ok(upper.clone()), "any two opposite corners");
    }
    let p = positions[17];
    assert_eq!(vertices(&Select::Box([p.to_array(); 2]), &surface), Ok(vec![17]), "a box of one point");
    assert_eq!(vertices(&Select::Ball([p.x, p.y, p.z, 0.0]), &surface), Ok(vec![17]), "a ball of radius 0");
    let near = those(&surface, |q| q.distance(p) <= 0.9);
    assert!(near.len() > 5 && near.len() < positions.len() / 2);
    assert_eq!(vertices(&Select::Ball([p.x, p.y, p.z, 0.9]), &surface), Ok(near));
    for nothing in [Select::Ball([0.0, 0.0, 0.0, 1.0]), Select::Box([[-1.0; 3], [1.0; 3]])] {
        assert_eq!(vertices(&nothing, &surface), Err(SelectionError::Nothing), "{nothing:?}");
    }
}

#[test]
fn the_nearest_to_points() {
    let surface = shapes::sphere(1.0, 4).expect("a sphere");
    let positions = surface.positions.clone().expect("positions");
    let (a, b) = (31, 5);
    // From far outside the nearest vertex lies in that direction.
    let points = vec![(9.0 * positions[a]).to_array(), (0.99 * positions[b]).to_array()];
    assert_eq!(vertices(&Select::Nearest(points), &surface), Ok(vec![a, b]), "in the order of the points");
    assert_eq!(vertices(&Select::Nearest(vec![[0.0, 0.0, 1e3]]), &surface).expect("one").len(), 1);
}

#[test]
fn places_are_positions_or_coordinates() {
    let flat =
        shapes::flat_torus([1.0, 0.0], [0.0, 1.0], 8, 6, immerse::mesh::shapes::Grid::Square).expect("a flat torus");
    assert!(flat.positions.is_none());
    let coordinates = flat.coordinates.clone().expect("coordinates");
    let left: Vec<usize> = (0..coordinates.len()).filter(|&v| coordinates[v].x <= 0.3).collect();
    assert_eq!(vertices(&Select::Box([[0.0, -1.0, -1.0], [0.3, 2.0, 1.0]]), &flat), Ok(left));
    for section in
        [Select::Box([[0.0; 3], [1.0; 3]]), Select::Ball([0.0, 0.0, 0.0, 1.0]), Select::Nearest(vec![[0.0; 3]])]
    {
        assert_eq!(select_vertices(&section, &flat.mesh, None), Err(SelectionError::NoPositions), "{section:?}");
        let between = EdgeSelection::Between(section);
        assert_eq!(select_edges(&between, &flat.mesh, None), Err(SelectionError::NoPositions));
    }
}

#[test]
fn edges_by_their_ends() {
    let surface = annulus();
    let mesh = &surface.mesh;
    let ends = |e: EdgeId| mesh.edge_vertices(e).map(|v| v.index());
    let interior: Vec<EdgeId> = mesh.interior_edges().collect();
    let named: Vec<[usize; 2]> = interior.iter().rev().map(|&e| ends(e)).collect();
    let expected: Vec<EdgeId> = interior.iter().rev().copied().collect();
    assert_eq!(edges(&EdgeSelection::Edges(named.clone()), &surface), Ok(expected.clone()));
    let reversed = named.iter().map(|[a, b]| [*b, *a]).collect();
    assert_eq!(edges(&EdgeSelection::Edges(reversed), &surface), Ok(expected), "either end first");

    let rim = mesh.edges().find(|&e| mesh.is_boundary_edge(e)).map(ends).expect("a rim");
    let refused = edges(&EdgeSelection::Edges(vec![named[0], rim]), &surface);
    assert_eq!(refused, Err(SelectionError::BoundaryEdge { ends: rim }));
    let count = mesh.vertex_count();
    let far = (1..count).find(|&v| !mesh.edges().any(|e| ends(e) == [0, v] || ends(e) == [v, 0])).expect("far");
    for ends in [[0, 0], [0, far], [0, count], [usize::MAX, 1]] {
        assert_eq!(edges(&EdgeSelection::Edges(vec![ends]), &surface), Err(SelectionError::NoSuchEdge { ends }));
    }
    assert_eq!(edges(&EdgeSelection::Edges(Vec::new()), &surface), Err(SelectionError::Nothing));
}

#[test]
fn edges_between_selected_vertices() {
    let surface = annulus();
    let mesh = &surface.mesh;
    let half = Select::Box([[-2.0, 0.0, -1.0], [2.0, 2.0, 1.0]]);
    let chosen = vertices(&half, &surface).expect("half");
    let expected: Vec<EdgeId> = mesh
        .edges()
        .filter(|&e| !mesh.is_boundary_edge(e) && mesh.edge_vertices(e).iter().all(|v| chosen.contains(&v.index())))
        .collect();
    assert!(!expected.is_empty());
    assert_eq!(edges(&EdgeSelection::Between(half), &surface), Ok(expected), "boundary edges are passed over");
    // One ring of the boundary has no interior edge between its vertices, and one vertex has none at all.
    for lonely in [Select::Boundary(vec![0]), Select::Vertices(vec![0])] {
        assert_eq!(edges(&EdgeSelection::Between(lonely), &surface), Err(SelectionError::Nothing));
    }
    let beyond = EdgeSelection::Between(Select::Vertices(vec![usize::MAX]));
    assert!(matches!(edges(&beyond, &surface), Err(SelectionError::NoSuchVertex { .. })));
    let triangle = Mesh::from_faces(3, &[[0, 1, 2]]).expect("a triangle");
    let all = EdgeSelection::Between(Select::Vertices(vec![0, 1, 2]));
    assert_eq!(select_edges(&all, &triangle, None), Err(SelectionError::Nothing), "all its edges are boundary");
}
