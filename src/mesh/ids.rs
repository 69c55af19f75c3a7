//! Typed indices of mesh elements, so that a face cannot be used where a vertex is meant.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        pub struct $name(pub u32);

        impl $name {
            /// The index of this element in arrays stored per element.
            #[inline]
            pub fn index(self) -> usize {
                self.0 as usize
            }

            /// The element with this array index. An index that no mesh has, because 32 bits do not hold it, gives an
            /// element that no mesh has.
            #[inline]
            pub fn new(index: usize) -> Self {
                debug_assert!(index < u32::MAX as usize);
                Self(index.min(u32::MAX as usize) as u32)
            }
        }
    };
}

id!(
    /// A vertex.
    VertexId
);
id!(
    /// A face (an oriented triangle).
    FaceId
);
id!(
    /// An undirected edge.
    EdgeId
);
id!(
    /// A halfedge: edge `k` of face `f` is halfedge `3 f + k` and runs from corner `k` to corner `k + 1`.
    HalfedgeId
);

impl FaceId {
    /// Halfedge `k` (0, 1 or 2) of this face; halfedge 0 is the face's reference edge.
    #[inline]
    pub fn halfedge(self, k: usize) -> HalfedgeId {
        debug_assert!(k < 3);
        HalfedgeId::new(3 * self.index() + k)
    }

    /// The three halfedges of this face, reference edge first.
    #[inline]
    pub fn halfedges(self) -> [HalfedgeId; 3] {
        [self.halfedge(0), self.halfedge(1), self.halfedge(2)]
    }
}

impl HalfedgeId {
    /// The face this halfedge belongs to.
    #[inline]
    pub fn face(self) -> FaceId {
        FaceId(self.0 / 3)
    }

    /// The position of this halfedge in its face: 0, 1 or 2. Also the corner at its tail.
    #[inline]
    pub fn corner(self) -> usize {
        (self.0 % 3) as usize
    }

    /// The next halfedge counterclockwise in the same face.
    #[inline]
    pub fn next(self) -> HalfedgeId {
        self.face().halfedge((self.corner() + 1) % 3)
    }

    /// The previous halfedge in the same face.
    #[inline]
    pub fn previous(self) -> HalfedgeId {
        self.face().halfedge((self.corner() + 2) % 3)
    }
}
