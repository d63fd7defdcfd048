"""The commands in Python. A module NAME has parsed(arguments), the options, and run(options), which returns the exit code."""

NAMES = ("certify", "compare", "converge", "sweep", "reproduce", "movie", "revolve", "report", "infer", "crate", "map", "modes")
