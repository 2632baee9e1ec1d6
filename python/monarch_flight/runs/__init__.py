"""Flights as they are asked for, started, watched and told."""
