"""Ctrl-C while a call has released Python's lock."""

import signal
import threading


def interrupted(call, *arguments, looks=10, **options):
    """Whether Ctrl-C ends a call that asks for it so many times.

    Python itself handles one signal before the call and one after; only a call that asks meanwhile handles more.
    """
    seen, ended = 0, threading.Event()

    def handler(*_):
        nonlocal seen
        seen += 1
        if seen == looks:
            raise KeyboardInterrupt

    def send():
        while not ended.is_set():
            signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)

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
        thread.join()
        signal.signal(signal.SIGINT, before)
