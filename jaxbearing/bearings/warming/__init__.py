"""Temperatures of a bearing with a thermal network in time; the bearing is in its steady state at each instant."""
