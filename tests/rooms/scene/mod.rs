mod mistakes;
mod schema;
mod valid;
