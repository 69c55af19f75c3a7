//! Which faces hang together.

/// Which faces hang together, and which of them would have to be reversed.
pub(super) struct Components {
    parents: Vec<u32>,
    /// Whether a face is to be reversed if its parent is not.
    reversed: Vec<bool>,
}

impl Components {
    pub fn new(faces: usize) -> Components {
        Components { parents: (0..faces as u32).collect(), reversed: vec![false; faces] }
    }

    fn root(&mut self, face: usize) -> (usize, bool) {
        let (mut at, mut turned) = (face, false);
        while self.parents[at] as usize != at {
            turned ^= self.reversed[at];
            at = self.parents[at] as usize;
        }
        let (whole, mut at, mut left) = (at, face, turned);
        while self.parents[at] as usize != at {
            let (next, own) = (self.parents[at] as usize, self.reversed[at]);
            (self.parents[at], self.reversed[at]) = (whole as u32, left);
            left ^= own;
            at = next;
        }
        (whole, turned)
    }

    /// Joins two faces, one of which is to be reversed if `reverse`; `false` if that contradicts what was joined before.
    pub fn join(&mut self, f: usize, g: usize, reverse: bool) -> bool {
        let ((a, turned_a), (b, turned_b)) = (self.root(f), self.root(g));
        let wanted = turned_a ^ turned_b ^ reverse;
        if a == b {
            return !wanted;
        }
        self.parents[a.max(b)] = a.min(b) as u32;
        self.reversed[a.max(b)] = wanted;
        true
    }
}
