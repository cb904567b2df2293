#!/usr/bin/env python3
"""A host for the link of docs/link.md: steps a bank of dampers and prints its forces.

    python3 link_client.py HOST PORT [MODEL]

MODEL is a health model (`dashpot export --health --lang bin`): the client then sends the first damper's forces back as if a
sensor had measured them, and prints its health.
"""

import random
import socket
import struct
import sys
import zlib

PROTOCOL = 3
HELLO, STEP, LOAD_HEALTH, MEASURE, HEALTH = 0, 5, 16, 17, 18
WELCOME, DONE, FORCES, REFUSED, READING = 0, 1, 2, 8, 9
CORRUPT = 0
MAX_MEASURED = 8


def varint(value):
    out = bytearray()
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes(out + bytes([value]))


def reals(values):
    return varint(len(values)) + struct.pack(f"<{len(values)}f", *values)


def cobs(data):
    """Each code byte is the distance to the next; after a 255, no zero follows its 254 bytes."""
    out = bytearray()
    for part in data.split(b"\0"):
        while len(part) >= 254:
            out += b"\xff" + part[:254]
            part = part[254:]
        out += bytes([len(part) + 1]) + part
    return bytes(out)


def uncobs(frame):
    out = bytearray()
    while frame:
        code, part, frame = frame[0], frame[1 : frame[0]], frame[frame[0] :]
        out += part + (b"\0" if code < 255 and frame else b"")
    return bytes(out)


class Reader:
    """Reads the fields of a message one by one."""

    def __init__(self, data):
        self.data = data

    def take(self, count):
        taken, self.data = self.data[:count], self.data[count:]
        return taken

    def varint(self):
        value, shift = 0, 0
        while True:
            byte = self.take(1)[0]
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value

    def f32(self):
        return struct.unpack("<f", self.take(4))[0]

    def list(self, element):
        return [element() for _ in range(self.varint())]


class Client:
    def __init__(self, host, port):
        self.line = socket.create_connection((host, port), timeout=5)
        self.line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.received = b""
        self.session, self.sequence = random.randrange(1 << 16), 0

    def frame(self):
        while b"\0" not in self.received:
            self.received += self.line.recv(4096) or sys.exit("the target is gone")
        frame, self.received = self.received.split(b"\0", 1)
        return uncobs(frame)

    def ask(self, request):
        """Returns the answer's number and fields; repeats the request if a frame was damaged in transit."""
        self.sequence = (self.sequence + 1) % (1 << 32)
        header = varint(self.session) + varint(self.sequence)
        message = header + request
        for _ in range(8):
            self.line.sendall(cobs(message + struct.pack("<I", zlib.crc32(message))) + b"\0")
            plain = self.frame()
            answer, check = plain[:-4], plain[-4:]
            if struct.pack("<I", zlib.crc32(answer)) != check:
                continue
            fields = Reader(answer[len(header) :])
            number = fields.varint()
            if answer.startswith(header) and number != REFUSED:
                return number, fields
            if number == REFUSED and (refusal := fields.varint()) != CORRUPT:
                sys.exit(f"refused: {refusal}")
        sys.exit("no answer")

    def hello(self):
        number, fields = self.ask(varint(HELLO) + varint(PROTOCOL))
        assert number == WELCOME
        fields.varint()  # protocol
        version = fields.take(fields.varint()).decode()
        revisions = fields.list(fields.varint)
        fields.varint()  # scalar
        return version, revisions, fields.f32(), (fields.varint(), fields.varint())[1]

    def step(self, tick, displacements_m):
        number, fields = self.ask(varint(STEP) + varint(tick) + reals(displacements_m))
        assert number == FORCES and fields.varint() == tick
        return fields.list(fields.f32), fields.list(fields.varint)

    def load_health(self, slot, model):
        number, _ = self.ask(varint(LOAD_HEALTH) + varint(slot) + varint(len(model)) + model)
        assert number == DONE

    def measure(self, slot, samples):
        """Sends pairs of displacement (m) and force (N)."""
        for first in range(0, len(samples), MAX_MEASURED):
            batch = b"".join(struct.pack("<2f", *pair) for pair in samples[first : first + MAX_MEASURED])
            number, _ = self.ask(varint(MEASURE) + varint(slot) + varint(len(batch)) + batch)
            assert number == DONE

    def health(self, slot):
        """Returns value and standard deviation of seven estimates, then the usable samples, the rejected ones and the status."""
        number, fields = self.ask(varint(HEALTH) + varint(slot))
        assert number == READING
        names = "flow_factor", "stiffness_n_per_m", "clearance_m", "lag_s", "compliance_m_per_n"
        estimates = {name: (fields.f32(), fields.f32()) for name in names}
        samples, rejected, status = fields.varint(), fields.varint(), fields.varint()
        estimates |= {name: (fields.f32(), fields.f32()) for name in ["force_zero_n", "added_friction_n"]}
        return estimates, samples, rejected, status


def main():
    client = Client(sys.argv[1], int(sys.argv[2]))
    version, revisions, step_s, tick = client.hello()
    print(f"core {version}, {len(revisions)} dampers, step {step_s * 1e3:.3g} ms, tick {tick}")
    measured = []
    for step in range(1, 101):
        displacement_m = 0.02 * step_s * step  # 0.02 m/s
        forces_n, status = client.step(tick + step, [displacement_m] * len(revisions))
        measured.append((displacement_m, forces_n[0]))
    print("forces", " ".join(f"{force:.1f}" for force in forces_n), "N, status", status)
    if len(sys.argv) > 3:
        with open(sys.argv[3], "rb") as file:
            client.load_health(0, file.read())
        client.measure(0, measured)
        estimates, samples, rejected, status = client.health(0)
        value, deviation = estimates["flow_factor"]
        print(f"flow factor {value:.4f} +- {deviation:.4f} by {samples} samples, {rejected} rejected, status {status}")


if __name__ == "__main__":
    main()
