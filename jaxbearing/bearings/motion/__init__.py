"""Bearings in motion: integration, restart, batches and history, for every family with equations of motion."""
