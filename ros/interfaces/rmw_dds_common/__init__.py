"""Interfaces of rmw_dds_common."""
