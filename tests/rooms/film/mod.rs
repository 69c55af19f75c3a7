mod disk;
mod pictures;
mod renderer;
