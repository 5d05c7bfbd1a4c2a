//! The system of equations: numbering, assembly, order of elimination, factors, secants, Newton-Raphson.















