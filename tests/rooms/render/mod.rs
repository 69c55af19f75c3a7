mod camera;
mod coverage;
mod files;
mod framing;
mod looks;
mod picture;
mod text;
mod transparency;
