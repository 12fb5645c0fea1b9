"""The ``evenly`` command."""

import signal
import sys

from evenly import _evenly


def main() -> None:
    """Run the command line, and leave with its exit code."""
    # Until a run looks after Ctrl-C itself, it ends the program.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_evenly.command(["evenly", *sys.argv[1:]]))
