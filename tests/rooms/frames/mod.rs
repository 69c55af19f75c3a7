mod energy;
mod rims;
