mod disk;
mod pictures;
