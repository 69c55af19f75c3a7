//! Places of vertices on a grid, frame by frame, told from what is known before in time and nearby.
//!
//! A frame is guessed from those before it, and each vertex is then as far from its guess as its neighbours are from theirs,
//! which are told before it: parts of a surface that move move together.

use super::streams::{Stream, folded, push_planes};

/// How a frame is guessed from those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Guess {
    /// All vertices are in the middle.
    Middle = 0,
    /// Each vertex is where it was in the frame before.
    Still = 1,
    /// Each vertex goes on as from the frame before that one.
    Straight = 2,
}

/// The middle of the grid.
const MIDDLE: u16 = 1 << 15;

/// Places of vertices, frame by frame.
#[derive(Debug)]
pub(super) struct Places {
    order: Order,
    bytes: Vec<u8>,
    /// The last two frames, the later one first; x of all vertices, then y, then z.
    before: [Vec<u16>; 2],
    frames: usize,
}

impl Places {
    /// Of the vertices of these triangles.
    pub fn new(vertices: usize, triangles: &[[u32; 3]]) -> Places {
        let order = Order::of(vertices, triangles);
        Places { order, bytes: Vec::new(), before: [Vec::new(), Vec::new()], frames: 0 }
    }

    /// Adds a frame: a byte that says how it is guessed, and for each coordinate of each vertex by how much that is wrong.
    pub fn push(&mut self, points: &[[u16; 3]]) {
        let now: Vec<u16> = (0..3).flat_map(|axis| points.iter().map(move |point| point[axis])).collect();
        let guesses: &[Guess] = match self.frames {
            0 => &[Guess::Middle],
            1 => &[Guess::Still],
            _ => &[Guess::Still, Guess::Straight],
        };
        let tries = guesses.iter().map(|&guess| (guess, self.errors(guess, &now)));
        let cost = |errors: &[u16]| errors.iter().map(|&e| u64::from(16 - e.leading_zeros())).sum::<u64>();
        if let Some((guess, errors)) = tries.min_by_key(|(_, errors)| cost(errors)) {
            self.bytes.push(guess as u8);
            push_planes(&mut self.bytes, &errors);
        }
        self.before.swap(0, 1);
        self.before[0] = now;
        self.frames += 1;
    }

    fn errors(&self, guess: Guess, now: &[u16]) -> Vec<u16> {
        let [last, earlier] = &self.before;
        let guessed = |k: usize| match guess {
            Guess::Middle => MIDDLE,
            Guess::Still => last[k],
            Guess::Straight => last[k].wrapping_mul(2).wrapping_sub(earlier[k]),
        };
        // How far each is from its guess, as a signed number.
        let far: Vec<i16> = now.iter().enumerate().map(|(k, x)| x.wrapping_sub(guessed(k)).cast_signed()).collect();
        let vertices = self.order.starts.len() - 1;
        let error = |k: usize| {
            let (axis, v) = (k / vertices, k % vertices);
            let known = self.order.earlier_neighbours(v);
            let sum: i32 = known.iter().map(|&u| i32::from(far[axis * vertices + u as usize])).sum();
            let mean = sum / (known.len() as i32).max(1);
            folded(far[k].wrapping_sub(mean as i16).cast_unsigned())
        };
        (0..now.len()).map(error).collect()
    }

    pub fn finish(self, name: &str) -> Stream {
        Stream::of(name, &self.bytes)
    }
}

/// Vertices breadth first, with those of their neighbours that come before them.
#[derive(Debug)]
struct Order {
    /// Where the neighbours of each vertex begin, and where the last ones end.
    starts: Vec<usize>,
    neighbours: Vec<u32>,
}

impl Order {
    /// Neighbours are in the order of the triangles; one that is on both sides of an edge counts twice.
    fn of(vertices: usize, triangles: &[[u32; 3]]) -> Order {
        let mut all: Vec<Vec<u32>> = vec![Vec::new(); vertices];
        for corners in triangles {
            for k in 0..3 {
                all[corners[k] as usize].extend([corners[(k + 1) % 3], corners[(k + 2) % 3]]);
            }
        }
        let mut rank = vec![usize::MAX; vertices];
        let mut queue = Vec::with_capacity(vertices);
        for first in 0..vertices {
            let mut next = queue.len();
            if rank[first] == usize::MAX {
                rank[first] = queue.len();
                queue.push(first);
            }
            while let Some(&v) = queue.get(next) {
                next += 1;
                for u in all[v].iter().map(|&u| u as usize) {
                    if rank[u] == usize::MAX {
                        rank[u] = queue.len();
                        queue.push(u);
                    }
                }
            }
        }
        let (mut starts, mut neighbours) = (vec![0], Vec::new());
        for (v, list) in all.iter().enumerate() {
            neighbours.extend(list.iter().filter(|&&u| rank[u as usize] < rank[v]));
            starts.push(neighbours.len());
        }
        Order { starts, neighbours }
    }

    fn earlier_neighbours(&self, v: usize) -> &[u32] {
        &self.neighbours[self.starts[v]..self.starts[v + 1]]
    }
}
