mod formula_bits;
mod values;
