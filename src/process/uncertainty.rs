//! What the uncertainty of springs and coefficients makes of a deviation.
