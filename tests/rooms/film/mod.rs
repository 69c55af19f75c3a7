mod cache;
mod movie;
