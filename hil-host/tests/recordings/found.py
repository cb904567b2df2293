"""Writes random MDF4 files, damaged copies of them, and what asammdf reads from each: found.py FOLDER FILES COPIES.

For each file, NAME.answer has for each channel its name, its times and its values as doubles, NaN if invalid; it is
empty if asammdf cannot read the file.
"""

import logging
import os
import resource
import signal
import struct
import sys
import warnings
from pathlib import Path

import numpy as np
from asammdf import MDF

import random_files

SEED = 2026
KINDS = [random_files.of_asammdf, random_files.of_asammdf, random_files.of_logger, random_files.unfinished]


is_late = False


def stopped(*_):
    global is_late
    is_late = True
    raise TimeoutError


def answer(path, only=None):
    """What asammdf reads."""
    try:
        with MDF(path) as file:
            channels = [
                (channel.name, group, index)
                for group, one in enumerate(file.groups)
                for index, channel in enumerate(one.channels)
                if channel.name != "time" and (only is None or channel.name in only)
            ]
            return b"".join(of_channel(file, *channel) for channel in channels)
    except (Exception, SystemExit):
        return b""


def answer_in_time(path):
    """What asammdf reads from a damaged file, which may keep it busy for ever, so it gets little time."""
    global is_late
    is_late = False
    # asammdf may catch the error, so it is raised again; if its C does not return, a signal ends the process.
    signal.setitimer(signal.ITIMER_PROF, 0.3, 0.3)
    signal.setitimer(signal.ITIMER_VIRTUAL, 3)
    try:
        found = answer(path, ["x", "F"])
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    return b"" if is_late else found


def of_channel(file, name, group, index):
    read = file.get(group=group, index=index, ignore_invalidation_bits=True)
    values = read.samples.astype(np.float64)
    if read.invalidation_bits is not None:
        values = np.where(np.asarray(read.invalidation_bits, bool), np.nan, values)
    times = read.timestamps.astype(np.float64)
    text = name.encode()
    return struct.pack("<II", len(text), len(values)) + text + times.tobytes() + values.tobytes()


def damaged(random, data):
    data = bytearray(data)
    kind = random.integers(0, 4)
    at = int(random.integers(0, len(data)))
    if kind == 0:
        data[at] ^= int(random.integers(1, 256))
    elif kind == 1:
        del data[at:]
    elif kind == 2:
        # Two parts of the disk in the wrong order.
        length = int(random.choice([8, 64, 512]))
        first, second = sorted(random.integers(0, max(len(data) // length, 1), 2) * length)
        part = data[first : first + length]
        if second + length <= len(data) and first + length <= second:
            data[first : first + length] = data[second : second + length]
            data[second : second + length] = part
    else:
        data[at : at + 64] = bytes(len(data[at : at + 64]))
    return bytes(data)


def main(folder, files, copies):
    folder = Path(folder)
    for index in range(int(files)):
        random = np.random.default_rng([SEED, index])
        path = folder / f"{index:04}.mf4"
        KINDS[index % len(KINDS)](random, path)
        path.with_suffix(".answer").write_bytes(answer(path))
    paths = []
    for index in range(int(copies)):
        random = np.random.default_rng([SEED, 1, index])
        source = folder / f"{index % int(files):04}.mf4"
        paths.append(folder / f"damaged_{index:04}.mf4")
        paths[-1].write_bytes(damaged(random, source.read_bytes()))
    answer_all(paths)


def answer_all(paths):
    """Some damaged files crash or hang asammdf: another process reads them, and the next goes on behind such a file."""
    while paths:
        child = os.fork()
        if child == 0:
            for path in paths:
                path.with_suffix(".answer").write_bytes(answer_in_time(path))
            os._exit(0)
        os.waitpid(child, 0)
        paths = [path for path in paths if not path.with_suffix(".answer").exists()]
        if paths:
            paths.pop(0).with_suffix(".answer").write_bytes(b"")


if __name__ == "__main__":
    resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))
    signal.signal(signal.SIGPROF, stopped)
    logging.disable(logging.CRITICAL)
    warnings.simplefilter("ignore")
    main(*sys.argv[1:])
