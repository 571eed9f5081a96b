"""Experiments and benchmarks: what the software does, in figures."""
