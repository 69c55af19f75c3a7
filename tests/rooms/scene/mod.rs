mod mistakes;
mod schema;
mod sequences;
mod valid;
