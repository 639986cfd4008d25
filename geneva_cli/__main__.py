"""The entry point, ``geneva`` and ``python -m geneva_cli``.

Loading the rest takes most of a short run, so Ctrl-C is answered before anything else is imported.
"""

import gc
import os
import signal
import sys
from types import FrameType


def main() -> None:
    """Run the command line; Ctrl-C ends it at once and without a word, as status 130.

    What must not be left half done, a file being written, has a handler of its own meanwhile.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:  # not where it is ignored
        signal.signal(signal.SIGINT, _stop)
    # What is imported stays: searching it for garbage takes a tenth of a short run. The largest
    # import, for a DXF file, is of some 120,000 objects.
    gc.set_threshold(250_000)
    if sys.flags.optimize > 1:  # commands read their options from docstrings, which are dropped
        sys.stderr.write("geneva: cannot run under -OO; unset PYTHONOPTIMIZE, or set it to 1\n")
        sys.exit(2)
    from geneva_cli.cli.app import main as run

    run()


def _stop(number: int, frame: FrameType | None) -> None:
    os._exit(128 + number)


if __name__ == "__main__":
    main()
