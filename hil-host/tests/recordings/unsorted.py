"""Unsorted MDF4, which asammdf can read but not write: one data group with the records of several channel groups in the order
of time, each preceded by its group's number, and variable-length texts among them. The blocks follow ASAM MDF 4.1; make.py
asserts that asammdf reads the same values.
"""

import struct

# Types of channels (cn_type) and of their values (cn_data_type), little-endian.
FIXED, VARIABLE_LENGTH, MASTER = 0, 1, 2
REAL, STRING_UTF8 = 4, 7
IS_VARIABLE_LENGTH = 1  # cg_flags
FAST, SLOW, NOTES = 1, 2, 3  # Record numbers of the groups.


class Blocks:
    """Sequence of blocks, each written before those that link to it."""

    def __init__(self):
        header_bytes = 24 + 6 * 8 + 32
        self.bytes = bytearray(b"MDF     4.10    made    ")
        self.bytes += struct.pack("<4xH34x", 410)
        self.bytes += bytes(header_bytes)

    def add(self, mark, links, data, at=None):
        block = struct.pack(f"<4s4xQQ{len(links)}Q", mark, 24 + 8 * len(links) + len(data), len(links), *links)
        block += data
        if at is None:
            self.bytes += bytes(-len(self.bytes) % 8)
            at = len(self.bytes)
            self.bytes += block
        else:
            self.bytes[at : at + len(block)] = block
        return at

    def text(self, text):
        text = text.encode() + b"\0"
        return self.add(b"##TX", [], text + bytes(-len(text) % 8))

    def channel(self, following, name, unit, kind, number, byte, bits, data=0):
        sync = 1 if kind == MASTER else 0  # Time.
        content = struct.pack("<4B4I2BH6d", kind, sync, number, 0, byte, bits, 0, 0, 0, 0, 0, *[0.0] * 6)
        links = [following, 0, self.text(name), 0, 0, data, self.text(unit) if unit else 0, 0]
        return self.add(b"##CN", links, content)

    def group(self, following, channel, name, number, count, flags, sizes):
        content = struct.pack("<QQHH4x2I", number, count, flags, 0, *sizes)
        return self.add(b"##CG", [following, channel, self.text(name) if name else 0, 0, 0, 0], content)


def records(time_s, displacement_mm, force_n):
    """Records as written by a logger: every tenth row also has a record of the slow group, every seventh a note of varying length."""
    notes_bytes = 0
    for row, values in enumerate(zip(time_s, displacement_mm, force_n)):
        if row % 10 == 0:
            yield struct.pack("<Bdf", SLOW, values[0], 20.0 + row / 8)
        if row % 7 == 0:
            note = f"row {row}" + "!" * (row % 50) + "\0"
            yield struct.pack("<BI", NOTES, len(note)) + note.encode()
            place, notes_bytes = notes_bytes, notes_bytes + 4 + len(note)
        yield struct.pack("<BdddQ", FAST, *values, place)


def write(path, time_s, displacement_mm, force_n, block_bytes=None):
    """Writes the file. With `block_bytes`, the records are divided into blocks of this size, which also divides records."""
    blocks, rows = Blocks(), len(time_s)
    slow_rows, notes = -(-rows // 10), -(-rows // 7)
    data = b"".join(records(time_s, displacement_mm, force_n))
    notes_bytes = sum(4 + len(f"row {row}") + row % 50 + 1 for row in range(0, rows, 7))
    # Texts have no record size; these fields contain their number of bytes instead.
    texts = blocks.group(0, 0, "", NOTES, notes, IS_VARIABLE_LENGTH, [notes_bytes, 0])
    temperature = blocks.channel(0, "Temperatur", "degC", FIXED, REAL, 8, 32)
    time = blocks.channel(temperature, "time", "s", MASTER, REAL, 0, 64)
    slow = blocks.group(texts, time, "langsam", SLOW, slow_rows, 0, [12, 0])
    note = blocks.channel(0, "Notiz", "", VARIABLE_LENGTH, STRING_UTF8, 24, 64, data=texts)
    force = blocks.channel(note, "Kraft", "N", FIXED, REAL, 16, 64)
    displacement = blocks.channel(force, "Weg", "mm", FIXED, REAL, 8, 64)
    time = blocks.channel(displacement, "time", "s", MASTER, REAL, 0, 64)
    fast = blocks.group(slow, time, "Messung", FAST, rows, 0, [32, 0])
    if block_bytes is None:
        data = blocks.add(b"##DT", [], data)
    else:
        parts = [data[at : at + block_bytes] for at in range(0, len(data), block_bytes)]
        parts = [blocks.add(b"##DT", [], part) for part in parts]
        list_data = struct.pack("<B3xIQ", 1, len(parts), block_bytes)  # Blocks of equal length.
        data = blocks.add(b"##DL", [0, *parts], list_data)
    whole = blocks.add(b"##DG", [0, fast, data, 0], struct.pack("<B7x", 1))  # Record numbers of one byte.
    comment = blocks.text("made")
    history = blocks.add(b"##FH", [0, comment], struct.pack("<QhhB3x", 0, 0, 0, 0))
    header = [whole, history, 0, 0, 0, 0]
    blocks.add(b"##HD", header, struct.pack("<QhhBBBxdd", 0, 0, 0, 0, 0, 0, 0.0, 0.0), at=64)
    path.write_bytes(blocks.bytes)
