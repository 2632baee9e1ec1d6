"""monarch report: a page of a run, or of several beside each other."""

NAME = "report.html"  # in the folder of a run
MOST = 6  # runs in a page
