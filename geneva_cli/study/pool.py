"""Work spread over processes, with results in order."""

import gc
import os
import signal
import sys
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

import geneva_cli.progress as progress
from geneva_cli.errors import GenevaError

T = TypeVar("T")
R = TypeVar("R")


def mapped(work: Callable[[T], R], items: Iterable[T], workers: int) -> Iterator[R]:
    """Yield ``work`` of each item, in order, from several processes or, for 1 worker, this one."""
    if workers < 2:
        yield from map(work, items)
        return
    import multiprocessing
    from concurrent.futures import Future, ProcessPoolExecutor
    from concurrent.futures.process import BrokenProcessPool

    # A fork does not start the program again; systems without it do.
    methods = multiprocessing.get_all_start_methods()
    context = multiprocessing.get_context("fork" if "fork" in methods else None)
    most = 61 if sys.platform == "win32" else workers  # it waits for 61 at most
    pool = ProcessPoolExecutor(min(workers, most), context, _attend)
    waiting: deque[Future[R]] = deque()
    try:
        for item in items:
            waiting.append(pool.submit(work, item))
            if len(waiting) > 4 * workers:  # so that memory stays bounded
                yield waiting[0].result()
                waiting.popleft()
        while waiting:
            yield waiting[0].result()
            waiting.popleft()
    except BrokenProcessPool:
        text = "a process that computed some designs was stopped from outside, or ran out of "
        raise GenevaError(f"{text}memory; try fewer designs at a time") from None
    finally:  # a run that is stopped waits for no design
        pool.shutdown(wait=all(one.done() for one in waiting), cancel_futures=True)


def cores() -> int:
    """The number of cores that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # a system without this call
        return os.cpu_count() or 1


def _attend() -> None:
    """Set up a worker process, which ends with the program that started it."""
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    progress.maker = None  # the parent process shows the progress of all
    gc.freeze()  # the objects of the parent stay
    gc.set_threshold(50_000)  # new objects: the work makes little cyclic garbage
    threading.Thread(target=_leave, daemon=True).start()


def _leave() -> None:
    import multiprocessing

    parent = multiprocessing.parent_process()
    if parent:
        parent.join()
        os._exit(1)
