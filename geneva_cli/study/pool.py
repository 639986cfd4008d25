"""Work spread over processes, with its results in order."""

from __future__ import annotations

import gc
import multiprocessing
import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, TypeVar

from geneva_cli.errors import GenevaError
from geneva_cli.progress import show_with

if TYPE_CHECKING:
    from concurrent.futures import Future

T = TypeVar("T")
R = TypeVar("R")
GARBAGE = 50_000  # new objects after which a worker looks for those in circles: work makes few
AHEAD = 4  # results that may wait for each worker, so that memory stays bounded


def mapped(
    work: Callable[[T], R],
    items: Iterable[T],
    workers: int,
    what: str = "designs",
    meanwhile: Callable[[], None] | None = None,
) -> Iterator[R]:
    """``work`` of each item, in order, by several processes, or by this one for 1 worker.

    Raises GenevaError if a process is ended from outside; ``what`` is the word for the items in it.
    ``meanwhile`` is what this process does while others work, if there is work for all of them.
    """
    if workers < 2:
        yield from map(work, items)
        return
    from concurrent.futures import ProcessPoolExecutor
    from concurrent.futures.process import BrokenProcessPool

    # A fork needs no second start of the program; where there is none, there is one.
    methods = multiprocessing.get_all_start_methods()
    context = multiprocessing.get_context("fork" if "fork" in methods else None)
    with ProcessPoolExecutor(workers, context, _attend) as pool:
        waiting: deque[Future[R]] = deque()
        try:
            for item in items:
                waiting.append(pool.submit(work, item))
                if meanwhile and len(waiting) > workers:  # each has something to do
                    meanwhile()
                    meanwhile = None
                if len(waiting) > AHEAD * workers:
                    yield waiting.popleft().result()
            while waiting:
                yield waiting.popleft().result()
        except BrokenProcessPool:
            raise GenevaError(
                f"a process that computed some of the {what} was stopped from outside, or ran out "
                f"of memory; try fewer {what} at a time"
            ) from None


def cores() -> int:
    """The number of cores that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # a system that does not say
        return os.cpu_count() or 1


def _attend() -> None:
    """Make a worker end with the program that started it, and silently by Ctrl-C where that ends
    the program: one in the background of a script is told to ignore it.
    """
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    show_with(None)  # the process that waits shows how far all are
    gc.freeze()  # what the program was made of stays
    gc.set_threshold(GARBAGE)
    threading.Thread(target=_leave, daemon=True).start()


def _leave() -> None:
    parent = multiprocessing.parent_process()
    if parent:
        parent.join()
        os._exit(1)
