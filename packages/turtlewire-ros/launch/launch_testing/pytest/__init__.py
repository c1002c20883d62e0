"""Lets pytest collect modules whose ``generate_test_description`` is marked ``launch_test``."""
