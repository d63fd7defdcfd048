"""The project's numbers: studies, the tables they give, and the pages and figures that show them. `make results` is the command."""
