"""MDF4 as loggers write it and asammdf does not: unsorted records, blocks that divide records, numbers of any width,
and files that were not finished. The blocks follow ASAM MDF 4.1.
"""

import struct
import zlib

import numpy as np

from unsorted import FIXED, MASTER, REAL, Blocks

UNSIGNED, SIGNED = 0, 2  # cn_data_type, little-endian; one more is big-endian.
COUNTS, LAST_LENGTH, LAST_LIST = 1, 4, 16  # id_unfin_flags.


class Number:
    """A channel: a type of numpy, or an integer of any width at a bit of a byte."""

    def __init__(self, name, unit, values, dtype=None, bits=None, bit=0, big_endian=False):
        self.name, self.unit, self.values = name, unit, values
        self.dtype, self.bits, self.bit, self.big_endian = dtype, bits, bit, big_endian
        if dtype is not None:
            self.bits, self.bit = 8 * dtype.itemsize, 0
            self.big_endian = dtype.byteorder == ">"

    def kind(self):
        kinds = {"f": REAL, "u": UNSIGNED, "i": SIGNED}
        kind = kinds[self.dtype.kind] if self.dtype is not None else UNSIGNED
        return kind + self.big_endian

    def bytes_of_rows(self):
        """Bytes of each row, as an array of rows and bytes."""
        if self.dtype is not None:
            values = self.values.astype(self.dtype)
            return values.view(np.uint8).reshape(len(values), -1)
        length = (self.bit + self.bits + 7) // 8
        order = "big" if self.big_endian else "little"
        rows = [(int(value) << self.bit).to_bytes(length, order) for value in self.values]
        return np.frombuffer(b"".join(rows), np.uint8).reshape(len(rows), length)


class Group:
    def __init__(self, name, time_s, numbers):
        time = Number("time", "s", time_s, np.dtype("<f8"))
        self.name, self.time_s, self.numbers = name, time_s, [time, *numbers]

    def records(self):
        return np.hstack([number.bytes_of_rows() for number in self.numbers])


class Writer:
    """`number_bytes` is the length of record numbers, `block_bytes` that of blocks (None for one block), `zipped` the
    type of compression (None, 0, or 1 with transposition), and `flags` are those of an unfinished file.
    """

    def __init__(self, number_bytes=0, block_bytes=None, zipped=None, flags=0):
        self.blocks = Blocks()
        self.number_bytes, self.block_bytes, self.zipped = number_bytes, block_bytes, zipped
        self.flags = flags
        self.block_at = []

    def write(self, path, data_groups):
        """Each data group is a list of groups; several groups in one are unsorted."""
        following = 0
        placed = []
        for groups in reversed(data_groups):
            following, data_link = self.add_data_group(following, groups)
            placed.append((data_link, groups))
        comment = self.blocks.text("made")
        history = self.blocks.add(b"##FH", [0, comment], struct.pack("<QhhB3x", 0, 0, 0, 0))
        header = struct.pack("<QhhBBBxdd", 0, 0, 0, 0, 0, 0, 0.0, 0.0)
        self.blocks.add(b"##HD", [following, history, 0, 0, 0, 0], header, at=64)
        for data_link, groups in reversed(placed):
            at = self.add_data(self.stream(groups), groups)
            self.blocks.bytes[data_link : data_link + 8] = struct.pack("<Q", at)
        if self.flags:
            self.blocks.bytes[:8] = b"UnFinMF "
            self.blocks.bytes[60:62] = struct.pack("<H", self.flags)
        path.write_bytes(self.blocks.bytes)

    def add_data_group(self, following, groups):
        first = 0
        for number, group in reversed(list(enumerate(groups, 1))):
            channel, byte = 0, 0
            places = []
            for one in group.numbers:
                places.append((one, byte))
                byte += (one.bit + one.bits + 7) // 8
            for one, at in reversed(places):
                channel = self.add_channel(channel, one, at)
            count = 0 if self.flags & COUNTS else len(group.time_s)
            first = self.blocks.group(first, channel, group.name, number, count, 0, [byte, 0])
        data = struct.pack("<B7x", self.number_bytes)
        at = self.blocks.add(b"##DG", [following, first, 0, 0], data)
        return at, at + 24 + 16

    def add_channel(self, following, one, byte):
        kind = MASTER if one.name == "time" else FIXED
        sync = 1 if kind == MASTER else 0
        numbers = (kind, sync, one.kind(), one.bit, byte, one.bits, 0, 0, 0, 0, 0, *[0.0] * 6)
        links = [following, 0, self.blocks.text(one.name), 0, 0, 0, self.blocks.text(one.unit), 0]
        return self.blocks.add(b"##CN", links, struct.pack("<4B4I2BH6d", *numbers))

    def stream(self, groups):
        """Records in the order of time."""
        rows = []
        for number, group in enumerate(groups, 1):
            prefix = number.to_bytes(self.number_bytes, "little") if self.number_bytes else b""
            records = group.records()
            rows += [(time, number, prefix + record.tobytes()) for time, record in zip(group.time_s, records)]
        return b"".join(record for _, _, record in sorted(rows, key=lambda row: row[:2]))

    def add_data(self, data, groups):
        step = self.block_bytes or max(len(data), 1)
        parts = [data[at : at + step] for at in range(0, len(data), step)] or [b""]
        columns = sum(number.bytes_of_rows().shape[1] for number in groups[0].numbers) + self.number_bytes
        if self.flags & LAST_LIST:
            # The list is written first and gets its links at the end.
            count = len(parts) + 3
            listed = self.blocks.add(b"##DL", [0] * (count + 1), struct.pack("<B3xIQ", 1, count, step))
            for part in parts:
                self.add_block(part, columns)
            self.open_last()
            return listed
        addresses = [self.add_block(part, columns) for part in parts]
        self.open_last()
        if self.block_bytes is None:
            return addresses[0]
        listed = self.blocks.add(b"##DL", [0, *addresses], struct.pack("<B3xIQ", 1, len(parts), step))
        if self.zipped is None:
            return listed
        return self.blocks.add(b"##HL", [listed], struct.pack("<HB5x", 1, self.zipped))

    def add_block(self, data, columns):
        if self.zipped is None:
            at = self.blocks.add(b"##DT", [], data)
        else:
            stored = data
            if self.zipped == 1:
                rows = len(data) // columns
                whole = np.frombuffer(data[: rows * columns], np.uint8).reshape(rows, columns)
                stored = whole.T.tobytes() + data[rows * columns :]
            packed = zlib.compress(stored)
            columns = columns if self.zipped == 1 else 0
            content = struct.pack("<2sBxIQQ", b"DT", self.zipped, columns, len(data), len(packed))
            at = self.blocks.add(b"##DZ", [], content + packed)
        self.block_at.append(at)
        return at

    def open_last(self):
        if self.flags & LAST_LENGTH and self.zipped is None:
            at = self.block_at[-1] + 8
            self.blocks.bytes[at : at + 8] = struct.pack("<Q", 24)
