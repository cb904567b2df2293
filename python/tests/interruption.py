"""Ctrl-C while a call has released the GIL."""

import signal
import threading


def interrupted(call, *arguments, looks=10, **options):
    """Returns True if Ctrl-C ends a call that checks for it `looks` times.

    Python itself handles one signal before the call and one after; only a call that checks in between handles more.
    """
    seen, handled, ended = 0, threading.Event(), threading.Event()

    def handler(*_):
        nonlocal seen
        seen += 1
        handled.set()
        if seen == looks:
            raise KeyboardInterrupt

    def send():
        # One signal at a time, because a constantly interrupted thread makes no progress.
        while not ended.is_set():
            handled.clear()
            signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)
            handled.wait()

    before = signal.signal(signal.SIGINT, handler)
    thread = threading.Thread(target=send)
    try:
        thread.start()
        call(*arguments, **options)
        return False
    except KeyboardInterrupt:
        return True
    finally:
        seen = looks
        ended.set()
        handled.set()
        thread.join()
        signal.signal(signal.SIGINT, before)
