"""Random MDF4 files, each determined by its number: of asammdf's writer, and of loggers."""

import numpy as np
from asammdf import MDF, Signal

from logger_files import COUNTS, LAST_LENGTH, LAST_LIST, Group, Number, Writer

TYPES = ["f2", "f4", "f8", "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8"]


def times(random, rows):
    step_s = random.choice([0.0005, 0.001, 0.01])
    late = random.integers(0, 4, rows) / 10 if random.random() < 0.5 else np.zeros(rows)
    return random.choice([0.0, 3.5]) + step_s * (np.arange(rows) + late)


def type_of(random):
    return np.dtype(random.choice(["<", ">"]) + random.choice(TYPES))


def values(random, rows, dtype):
    if dtype.kind == "f":
        scale = 100.0 if dtype.itemsize == 2 else 1e4
        return (scale * random.standard_normal(rows)).astype(dtype)
    least, most = np.iinfo(dtype).min, np.iinfo(dtype).max
    if dtype.itemsize == 8:
        # asammdf 8.8.28 reads some integers of more than 53 bits with a wrong sign.
        least, most = max(least, -(2**52)), min(most, 2**52)
    native = dtype.newbyteorder("=")
    return random.integers(least, most, rows, native, endpoint=True).astype(dtype)


def conversion(random, dtype):
    if dtype.kind == "f" and dtype.itemsize < 8:
        # asammdf would round the results to the precision of the type.
        return None
    kind = random.integers(0, 6)
    if kind == 0:
        return {"a": float(random.choice([0.5, 0.001, -2.0])), "b": float(random.choice([0.0, 7.25]))}
    if kind == 1 and dtype.kind != "f":
        return {"P1": 0.0, "P2": 0.25, "P3": 1.0, "P4": 0.0, "P5": 0.0, "P6": 1.0}
    if kind == 2 and dtype.kind != "f" and dtype.itemsize <= 2:
        raw = np.array([-40000.0, -50.0, 0.0, 60.0, 70000.0])
        return {f"raw_{i}": x for i, x in enumerate(raw)} | {
            f"phys_{i}": x for i, x in enumerate([-9.0, -1.0, 0.5, 2.0, 12.0])
        } | {"interpolation": True}
    return None


def signal(random, name, unit, time_s):
    dtype = type_of(random)
    rows = len(time_s)
    invalid = random.random(rows) < 0.1 if random.random() < 0.25 else None
    return Signal(
        values(random, rows, dtype),
        time_s,
        unit,
        name,
        conversion=conversion(random, dtype),
        invalidation_bits=invalid,
    )


def of_asammdf(random, path):
    """Groups of several rates; the first has the displacement x and the force F."""
    file = MDF(version=str(random.choice(["4.00", "4.10", "4.11", "4.20"])))
    # Blocks of a few records; 0 makes one block.
    file.configure(write_fragment_size=int(random.choice([0, 0, 100, 999])))
    rows = int(random.integers(1, 200))
    for group in range(random.integers(1, 4)):
        time_s = times(random, max(rows // (1 + 4 * group), 1))
        signals = [signal(random, f"c{group}_{one}", "m", time_s) for one in range(random.integers(1, 4))]
        if group == 0:
            signals += [signal(random, "x", "m", time_s), signal(random, "F", "N", time_s)]
        file.append(signals, acq_name=f"group {group}", comment="made")
    file.save(path, overwrite=True, compression=int(random.integers(0, 3)))
    file.close()


def number(random, name, unit, rows):
    if random.random() < 0.4:
        bits, bit = int(random.integers(1, 54)), int(random.integers(0, 8))
        raw = random.integers(0, 2**bits, rows, np.uint64)
        return Number(name, unit, raw, bits=bits, bit=bit, big_endian=random.random() < 0.5)
    dtype = type_of(random)
    return Number(name, unit, values(random, rows, dtype), dtype)


def groups_of(random, count):
    rows = int(random.integers(2, 150))
    groups = []
    for group in range(count):
        time_s = times(random, max(rows // (1 + 3 * group), 1))
        of_rows = len(time_s)
        names = [f"c{group}_{one}" for one in range(random.integers(1, 3))]
        numbers = [number(random, name, "m", of_rows) for name in names]
        if group == 0:
            numbers += [number(random, "x", "m", of_rows), number(random, "F", "N", of_rows)]
        groups.append(Group(f"group {group}", time_s, numbers))
    return groups


def of_logger(random, path):
    """Sorted or unsorted records, in blocks that divide them."""
    count = int(random.integers(1, 4))
    groups = groups_of(random, count)
    is_unsorted = count > 1 and random.random() < 0.7
    number_bytes = int(random.choice([1, 2, 4, 8])) if is_unsorted else int(random.choice([0, 1]))
    block_bytes = random.choice([None, 7, 61, 256, 4000])
    zipped = random.choice([None, None, 0, 1])
    writer = Writer(number_bytes, block_bytes, zipped)
    writer.write(path, [groups] if is_unsorted else [[group] for group in groups])


def unfinished(random, path):
    """A logger that crashed: numbers of rows, the last length or the links of a list are missing, and the file ends
    anywhere in its last records.
    """
    count = int(random.integers(1, 3))
    groups = groups_of(random, count)
    is_unsorted = count > 1
    number_bytes = int(random.choice([1, 2])) if is_unsorted else 0
    flags, block_bytes, zipped = COUNTS, None, None
    kind = random.integers(0, 4)
    if kind == 1:
        flags |= LAST_LENGTH
    elif kind == 2:
        flags, block_bytes = flags | LAST_LENGTH | LAST_LIST, int(random.choice([61, 256]))
    elif kind == 3:
        flags, block_bytes, zipped = flags | LAST_LIST, int(random.choice([61, 256])), int(random.integers(0, 2))
    writer = Writer(number_bytes, block_bytes, zipped, flags)
    writer.write(path, [groups])
    whole = path.read_bytes()
    if kind > 0:
        first = writer.block_at[0] + 24
        path.write_bytes(whole[: int(random.integers(first, len(whole) + 1))])
