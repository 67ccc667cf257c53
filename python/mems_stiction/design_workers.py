"""Points of a sweep in processes of this machine: each gets one when it has answered.

No pool of the standard library: those have threads of their own, and an interruption that falls
between two steps of a lock leaves it locked, so that the pool waits for its thread for ever.
"""

from __future__ import annotations

import contextlib
import itertools
import multiprocessing
import os
import signal
import threading
from multiprocessing import connection
from typing import Any, Dict, Generator, Iterator, List, Tuple

from mems_stiction._settings import Error
from mems_stiction.design_points import Found, Holding

Answers = Generator[Tuple[Dict[str, float], Found], None, None]


def answers_of_processes(holding: Holding, points: List[Dict[str, float]], count: int) -> Answers:
    """Each point with what holds there, in the order in which they end. The processes end with the
    generator. Raises Error where one has ended."""
    context = multiprocessing.get_context(
        "spawn"
    )  # not forked: the core's threads and locks would be copied as they stand
    processes: List[Any] = []
    under_way: Dict[Any, Dict[str, float]] = {}
    waiting = iter(points)
    try:
        for point in itertools.islice(waiting, count):
            ours, theirs = context.Pipe()
            process = context.Process(target=_work, args=(theirs,), daemon=True)
            process.start()
            processes.append(process)
            theirs.close()
            # not with its start: that waits for ever for a process that has ended before it read
            with _named_end():
                ours.send(holding)
                ours.send(point)
            under_way[ours] = point
        while under_way:
            answered: List[Any] = connection.wait(list(under_way))
            for ready in answered:
                point = under_way.pop(ready)
                with _named_end():
                    answer = ready.recv()
                if isinstance(answer, Exception):
                    raise answer
                yield point, answer
                for following in itertools.islice(waiting, 1):
                    with _named_end():
                        ready.send(following)
                    under_way[ready] = following
    finally:
        for process in processes:
            process.terminate()
        for process in processes:
            process.join()


@contextlib.contextmanager
def _named_end() -> Iterator[None]:
    """What a pipe says of a process that is no more, in words."""
    try:
        yield
    except (EOFError, OSError):
        raise Error(
            "a worker process has ended: memory may be short, or a program that calls "
            "design_sweep() lacks "
            '`if __name__ == "__main__":`; workers=1 does without other processes'
        ) from None


def _work(asked: Any) -> None:
    """In each process: Ctrl-C is the parent's, and nobody goes on without it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_end_with, args=(parent.sentinel,), daemon=True).start()
    holding: Holding = asked.recv()
    while True:
        point = asked.recv()
        try:
            asked.send(holding.at(point))
        except Exception as error:
            asked.send(error)


def _end_with(sentinel: Any) -> None:
    connection.wait([sentinel])
    os._exit(1)
