"""The subcommands of monarch, one module each: add_arguments(parser), run(arguments)."""
