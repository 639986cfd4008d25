"""Memory for arrays that are freed and allocated again all the time."""

from __future__ import annotations

from functools import cache


@cache
def keep_freed_memory() -> None:
    """Let the allocator keep up to 32 MB of freed memory for the next arrays.

    The allocator of Linux returns freed memory at the heap's end to the system, and gets it back
    page by page: a jet then takes up to twice as long. Once a large block was freed, the allocator
    keeps twice its size. The block is never written, so it takes no memory. Other allocators do not
    change.
    """
    import numpy

    numpy.empty(1 << 21)  # 16 MB
