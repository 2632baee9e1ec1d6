"""The keys that name the program of a node, and the package that it is of."""
ROLES = ("fluid", "flight", "wing", "guidance")
ALL = tuple(f"{role}_{part}" for role in ROLES for part in ("pkg", "node"))
