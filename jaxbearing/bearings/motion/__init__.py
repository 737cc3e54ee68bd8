"""Runs of bearings in time: settings, start, rates, integration, instants, history."""
