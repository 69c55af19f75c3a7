//! Tree/cotree generators of the first homology (Alg. 4), with boundary.
//!
//! Algorithm 4 takes any dual spanning tree and any primal spanning tree that avoids it. Two choices make
//! the result short and predictable (Erickson and Whittlesey's greedy generators): the dual tree holds
//! shortest paths from one face, and the primal tree is the one of greatest loop length. Collapsing the
//! boundary of a component to one node turns the relative generators that end on the boundary into
//! cycles like all others, and makes the same primal tree the one that Algorithm 3 needs, rooted at the boundary.

use super::Strip;
use crate::mesh::{EdgeId, FaceId, HalfedgeId, Mesh, VertexId};
use crate::metric::Metric;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// One generator: a closed triangle strip and the path of edges dual to it.
#[derive(Clone, Debug)]
pub struct Generator {
    /// γ_k, a generator of H₁(M*).
    pub strip: Strip,
    /// Γ_k, a closed path of interior edges, or one from boundary to boundary. It crosses γ_k once and
    /// all other strips of the basis not at all.
    pub path: Vec<EdgeId>,
    /// Length of the strip, measured through the centers of its faces.
    pub length: f64,
}

/// Generators of H₁(M*) and H₁(M, ∂M), 2g + max(b − 1, 0) for each component, shortest first within a
/// component, components in order of their first face; and the vertex tree they were found with.
#[derive(Clone, Debug)]
pub struct Homology {
    generators: Vec<Generator>,
    tree: VertexTree,
}

/// A spanning tree of the vertices of every component. Boundary vertices of a component are one node, its root;
/// a closed component is rooted at its first vertex.
#[derive(Clone, Debug)]
pub struct VertexTree {
    /// Per vertex: its interior edge toward the root; `None` at roots.
    pub parents: Vec<Option<EdgeId>>,
    /// Per vertex: the vertex at the other end of the parent edge.
    pub parent_vertices: Vec<Option<VertexId>>,
    /// Vertices, every parent before its children.
    pub order: Vec<VertexId>,
}

impl Homology {
    /// Finds generators that are short in the given metric.
    pub fn new(mesh: &Mesh, metric: &Metric) -> Homology {
        let (entries, distances) = shortest_dual_paths(mesh, metric);
        let in_cotree = |e: EdgeId| mesh.halfedges_of(e).any(|h| entries[h.face().index()] == Some(h));
        let mut loops: Vec<(f64, EdgeId)> = mesh
            .interior_edges()
            .filter(|&e| !in_cotree(e))
            .map(|e| {
                let ends: f64 = mesh.halfedges_of(e).map(|h| distances[h.face().index()]).sum();
                (ends + dual_length(mesh, metric, e), e)
            })
            .collect();
        loops.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));

        let mut nodes = Nodes::collapse_boundaries(mesh);
        let mut neighbors: Vec<Vec<(VertexId, EdgeId)>> = vec![Vec::new(); mesh.vertex_count()];
        let mut left_over = Vec::new();
        for (length, e) in loops {
            let [a, b] = mesh.edge_vertices(e);
            if nodes.join(a, b) {
                neighbors[a.index()].push((b, e));
                neighbors[b.index()].push((a, e));
            } else {
                left_over.push((length, e));
            }
        }
        let tree = root_tree(mesh, &neighbors);
        let mut face_components = vec![0; mesh.face_count()];
        for (k, component) in mesh.components().iter().enumerate() {
            component.iter().for_each(|f| face_components[f.index()] = k);
        }
        let component = |e: EdgeId| face_components[mesh.edge_halfedge(e).face().index()];
        left_over.sort_by(|a, b| (component(a.1)).cmp(&component(b.1)).then(a.0.total_cmp(&b.0)).then(a.1.cmp(&b.1)));
        let generators = left_over
            .into_iter()
            .map(|(length, e)| Generator {
                strip: close_strip(mesh, &entries, e),
                path: close_path(mesh, &tree, e),
                length,
            })
            .collect();
        Homology { generators, tree }
    }

    /// The generators, β₁ of them.
    pub fn generators(&self) -> &[Generator] {
        &self.generators
    }
    /// First Betti number.
    pub fn betti(&self) -> usize {
        self.generators.len()
    }
    /// The vertex spanning tree.
    pub fn tree(&self) -> &VertexTree {
        &self.tree
    }
}

/// Distance between the centers of the faces of an interior edge, through the middle of the edge.
fn dual_length(mesh: &Mesh, metric: &Metric, e: EdgeId) -> f64 {
    mesh.halfedges_of(e)
        .map(|h| {
            let length = |h: HalfedgeId| metric.length(mesh.edge(h));
            let (a, b, c) = (length(h), length(h.next()), length(h.previous()));
            (2.0 * (b * b + c * c) - a * a).max(0.0).sqrt() / 6.0 // a third of the median
        })
        .sum()
}

/// Dijkstra over faces from the first face of every component: per face the halfedge (inside the face)
/// through which its shortest path enters, `None` at roots, and its distance.
fn shortest_dual_paths(mesh: &Mesh, metric: &Metric) -> (Vec<Option<HalfedgeId>>, Vec<f64>) {
    #[derive(PartialEq)]
    struct Key(f64, FaceId);
    impl Eq for Key {}
    impl PartialOrd for Key {
        fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
            Some(self.cmp(other))
        }
    }
    impl Ord for Key {
        fn cmp(&self, other: &Self) -> std::cmp::Ordering {
            self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
        }
    }
    let mut entries = vec![None; mesh.face_count()];
    let mut distances = vec![f64::INFINITY; mesh.face_count()];
    let mut heap = BinaryHeap::new();
    for component in mesh.components() {
        distances[component[0].index()] = 0.0;
        heap.push(Reverse(Key(0.0, component[0])));
    }
    while let Some(Reverse(Key(distance, f))) = heap.pop() {
        if distance > distances[f.index()] {
            continue;
        }
        for h in f.halfedges() {
            let Some(twin) = mesh.twin(h) else { continue };
            let candidate = distance + dual_length(mesh, metric, mesh.edge(h));
            let g = twin.face();
            if candidate < distances[g.index()] {
                distances[g.index()] = candidate;
                entries[g.index()] = Some(twin);
                heap.push(Reverse(Key(candidate, g)));
            }
        }
    }
    (entries, distances)
}

/// Union-find over vertices.
struct Nodes(Vec<u32>);

impl Nodes {
    fn collapse_boundaries(mesh: &Mesh) -> Nodes {
        let mut nodes = Nodes((0..mesh.vertex_count() as u32).collect());
        for component in mesh.components() {
            let mut first = None;
            for v in component.iter().flat_map(|&f| mesh.corners(f)).filter(|&v| mesh.is_boundary_vertex(v)) {
                nodes.join(*first.get_or_insert(v), v);
            }
        }
        nodes
    }

    fn find(&mut self, v: VertexId) -> u32 {
        let mut root = v.0;
        while self.0[root as usize] != root {
            self.0[root as usize] = self.0[self.0[root as usize] as usize];
            root = self.0[root as usize];
        }
        root
    }

    /// Whether the two were apart.
    fn join(&mut self, a: VertexId, b: VertexId) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
        a != b
    }
}

fn root_tree(mesh: &Mesh, neighbors: &[Vec<(VertexId, EdgeId)>]) -> VertexTree {
    let mut parents = vec![None; mesh.vertex_count()];
    let mut parent_vertices = vec![None; mesh.vertex_count()];
    let mut seen = vec![false; mesh.vertex_count()];
    let mut order = Vec::with_capacity(mesh.vertex_count());
    for component in mesh.components() {
        let start = order.len();
        let corners = || component.iter().flat_map(|&f| mesh.corners(f));
        for v in corners().filter(|&v| mesh.is_boundary_vertex(v)) {
            if !std::mem::replace(&mut seen[v.index()], true) {
                order.push(v);
            }
        }
        if order.len() == start {
            let root = mesh.corners(component[0])[0];
            seen[root.index()] = true;
            order.push(root);
        }
        let mut next = start;
        while next < order.len() {
            let v = order[next];
            for &(child, edge) in &neighbors[v.index()] {
                if !std::mem::replace(&mut seen[child.index()], true) {
                    parents[child.index()] = Some(edge);
                    parent_vertices[child.index()] = Some(v);
                    order.push(child);
                }
            }
            next += 1;
        }
    }
    VertexTree { parents, parent_vertices, order }
}

/// The unique closed strip that crosses `e` and otherwise only edges of the dual tree.
#[allow(clippy::unreachable, reason = "the tree paths of the two sides of an edge outside the tree always close up")]
fn close_strip(mesh: &Mesh, entries: &[Option<HalfedgeId>], e: EdgeId) -> Strip {
    let to_root = |start: FaceId| {
        // Halfedges through which a walk to the root leaves each face.
        let mut exits = Vec::new();
        let mut f = start;
        while let Some(h) = entries[f.index()] {
            exits.push(h);
            match mesh.twin(h) {
                Some(twin) => f = twin.face(),
                None => break,
            }
        }
        exits
    };
    let h = mesh.edge_halfedge(e);
    let mut out = to_root(mesh.twin(h).unwrap_or(h).face());
    let mut back = to_root(h.face());
    while let (Some(a), Some(b)) = (out.last(), back.last())
        && a == b
    {
        out.pop();
        back.pop();
    }
    let mut exits = vec![h];
    exits.extend(out);
    exits.extend(back.iter().rev().filter_map(|&b| mesh.twin(b)));
    Strip::new(mesh, exits.clone()).unwrap_or_else(|| unreachable!("strip {exits:?} does not close"))
}

/// The unique relative cycle of `e` and edges of the vertex tree.
fn close_path(mesh: &Mesh, tree: &VertexTree, e: EdgeId) -> Vec<EdgeId> {
    let to_root = |start: VertexId| {
        let mut path = Vec::new();
        let mut v = start;
        while let (Some(edge), Some(parent)) = (tree.parents[v.index()], tree.parent_vertices[v.index()]) {
            path.push(edge);
            v = parent;
        }
        path
    };
    let [a, b] = mesh.edge_vertices(e).map(to_root);
    let shared = a.iter().rev().zip(b.iter().rev()).take_while(|(x, y)| x == y).count();
    let mut path = vec![e];
    path.extend(&a[..a.len() - shared]);
    path.extend(&b[..b.len() - shared]);
    path
}
