"""monarch report: a page of a run, or of several beside each other."""
