mod extends;
mod mistakes;
mod schema;
mod sequences;
mod settings;
mod valid;
