//! What nobody outside sees: balls, polynomials, and the search for roots.

mod ball;
mod polynomial;
mod search;
