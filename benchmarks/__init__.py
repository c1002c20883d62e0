"""Measurements against rivals, as ratios of one run: ``scripts/bench``."""
