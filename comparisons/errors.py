"""Exit codes, and the error that ends a command with one of them."""

BAD_INPUT, RUN_FAILED, IO_FAILURE, INTERRUPTED = 2, 3, 4, 130


class StudyError(Exception):
    """Ends the command with one line on stderr and an exit code: 2 bad input, 3 a run failed, 4 input or output."""

    def __init__(self, message, exit_code):
        super().__init__(message)
        self.exit_code = exit_code
