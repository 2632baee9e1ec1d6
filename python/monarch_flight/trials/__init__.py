"""Long trials of speed, endurance and faults, and comparisons."""
