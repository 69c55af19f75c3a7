mod energy;
