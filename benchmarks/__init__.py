"""Benchmarks against rivals, as ratios within one run: ``scripts/bench``."""
