mod alignment;
mod deform;
mod field_boundary;
mod fields;
mod periods;
mod pinned_lengths;
mod reconstruction;
