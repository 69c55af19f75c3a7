//! What is told of pictures in the making.

/// What happens while pictures are made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// A stage begins, which has this number of parts.
    Begin(&'static str, usize),
    /// This number of its parts is done.
    Done(usize),
    /// Something that is worth saying.
    Note(String),
}

/// Is told what happens, in order.
pub type Watch<'a> = dyn FnMut(Event) + Send + 'a;
