//! From what a scene says to the values of the rooms that it is for, one file per room.

mod mesh;
