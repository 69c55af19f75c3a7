mod linear_algebra;
