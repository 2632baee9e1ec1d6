"""Flights that are led, and their periodic flight."""
