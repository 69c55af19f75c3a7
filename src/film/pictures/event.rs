//! What is told of pictures in the making.

/// What happens while pictures are made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// A stage of so many parts begins.
    Begin(&'static str, usize),
    /// So many parts of it are done.
    Done(usize),
    /// Worth saying.
    Note(String),
}

/// Is told what happens, in order.
pub type Watch<'a> = dyn FnMut(Event) + Send + 'a;
