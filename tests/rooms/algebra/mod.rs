mod direct;
mod linear_algebra;
