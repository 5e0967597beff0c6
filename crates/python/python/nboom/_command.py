"""The command ``nboom``, which comes with the package."""

import os
import signal
import sys

from . import _nboom


def main() -> None:
    # The command has its own answer to Ctrl-C.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    code = _nboom.main(["nboom", *sys.argv[1:]])
    sys.stdout.flush()
    # Nothing of Python's is left to be done, and threads of the command may still wait.
    os._exit(code)
