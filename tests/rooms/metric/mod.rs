mod cones;
mod curvature_targets;
mod program;
mod ricci;
mod shortest_paths;
mod slivers;
