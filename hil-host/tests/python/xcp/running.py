"""A vehicle that runs with a server of XCP, and pyXCP as its master."""

import contextlib
import csv
import json
import os
import re
import struct
import subprocess
import tempfile
import threading
from pathlib import Path

from pyxcp.config import create_application_from_config
from pyxcp.daq_stim import DaqList, DaqOnlinePolicy
from pyxcp.master import Master

DASHPOT = os.environ["DASHPOT"]
# How long an answer may take on a busy machine.
PATIENCE_S = 600.0
NOTE = re.compile(r"note: XCP on \S+:(\d+) ")


class Running:
    """A command that runs in a folder of its own, on a free port."""

    def __init__(self, *arguments, address="127.0.0.1:0"):
        self.folder = tempfile.TemporaryDirectory()
        self.arguments = [DASHPOT, *arguments, "--format", "json", "--xcp", address]

    def __enter__(self):
        self.process = subprocess.Popen(
            self.arguments, cwd=self.folder.name, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        self.notes = []
        for line in self.process.stderr:
            self.notes.append(line)
            if found := NOTE.search(line):
                self.port = int(found.group(1))
                break
        else:
            self.process.communicate()
            self.folder.cleanup()
            raise AssertionError("".join(self.notes))
        # Nobody else reads what the command writes.
        self.reader = threading.Thread(target=lambda: self.notes.extend(self.process.stderr))
        self.reader.start()
        return self

    def end(self):
        """Waits for the end; returns the report."""
        report = self.process.stdout.read()
        code = self.process.wait()
        self.reader.join()
        assert code == 0, "".join(self.notes)
        return json.loads(report)

    def a2l(self):
        """The A2L file that the command has written."""
        return A2l((Path(self.folder.name) / "xcp.a2l").read_text())

    def columns(self, file, names):
        """Columns of a file with these names."""
        return columns(Path(self.folder.name) / file, names)

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
            self.process.communicate()
        self.reader.join()
        self.process.stdout.close()
        self.process.stderr.close()
        self.folder.cleanup()


class Vehicle(Running):
    """The locomotive."""

    def __init__(self, *options, address="127.0.0.1:0"):
        vehicle = ["vehicle", "--case", "straight-180", "--no-page", "--output", "."]
        super().__init__(*vehicle, *options, address=address)

    def history(self, names):
        """Columns of history.csv with these names."""
        return self.columns("history.csv", names)


def columns(path, names):
    """Columns of a CSV file with these names."""
    with open(path, newline="") as file:
        rows = csv.reader(file)
        header = next(rows)
        wanted = [header.index(name) for name in names]
        columns = zip(*[[float(row[index]) for index in wanted] for row in rows])
        return dict(zip(names, columns))


def plain_run(folder, *options):
    """Runs `dashpot vehicle` without a server."""
    command = [DASHPOT, "vehicle", "--no-page", "--output", ".", "--quiet", *options]
    subprocess.run(command, cwd=folder, check=True, capture_output=True)


class Collected(DaqOnlinePolicy):
    """Keeps all samples and the counters of all messages."""

    def __init__(self, daq_lists):
        super().__init__(daq_lists)
        self.wanted = 0
        self.samples = []
        self.times_us = []
        self.counters = []
        self.has_all = threading.Event()

    def run_until(self, wanted):
        """Measures until there are as many samples."""
        self.has_all.clear()
        self.wanted = wanted
        self.xcp_master.startStopDaqList(2, 0)
        self.start()
        measured = -1
        while not self.has_all.wait(60):
            # A busy machine is slow, but it goes on.
            assert len(self.samples) > measured, measured
            measured = len(self.samples)
        self.stop()

    def initialize(self):
        pass

    def finalize(self):
        pass

    def feed(self, category, counter, timestamp, payload):
        # Commands of the master have a counter of their own.
        if category.name != "CMD":
            self.counters.append(counter)
        if category.name == "DAQ" and payload[0] == 0:
            self.times_us.append(struct.unpack_from("<I", payload, 2)[0])
        super().feed(category, counter, timestamp, payload)

    def on_daq_list(self, daq_list, timestamp0, timestamp1, payload):
        self.samples.append(payload)
        if len(self.samples) >= self.wanted:
            self.has_all.set()

    def columns(self):
        """Samples of each signal; pyXCP has its own order of the signals."""
        names = [name for name, *_ in self.daq_lists[0].headers]
        return dict(zip(names, zip(*self.samples)))

    def lost(self):
        """Messages whose counters are missing."""
        pairs = zip(self.counters, self.counters[1:])
        return sum((after - before - 1) % 0x10000 for before, after in pairs)


@contextlib.contextmanager
def master(port, protocol="TCP", policy=None):
    """A master that has connected, and disconnects at the end."""
    eth = {"host": "127.0.0.1", "port": port, "protocol": protocol, "tcp_nodelay": True}
    config = {"Transport": {"timeout": PATIENCE_S, "Eth": eth}}
    application = create_application_from_config(config, log_level=50)
    application.transport.layer = "ETH"
    # Error codes are for the tests to see.
    application.general.disable_error_handling = True
    with Master("eth", config=application, policy=policy) as found:
        found.connect()
        yield found
        found.disconnect()


class A2l:
    """Addresses of an A2L file."""

    MEASUREMENT = re.compile(r"/begin MEASUREMENT (\S+) .*?ECU_ADDRESS (0x[0-9a-f]+)", re.S)
    CHARACTERISTIC = re.compile(r"/begin CHARACTERISTIC (\S+) \".*?\" VALUE (0x[0-9a-f]+)", re.S)

    def __init__(self, text):
        self.text = text
        self.measured = {name: int(address, 16) for name, address in self.MEASUREMENT.findall(text)}
        self.parameters = {name: int(address, 16) for name, address in self.CHARACTERISTIC.findall(text)}


def uploaded(master):
    """The A2L file that the slave has."""
    return A2l(master.identifier(4))


def daq_list(a2l, names):
    """A list of signals, sampled in each tick."""
    measured = [(name, a2l.measured[name], 0, "F64") for name in names]
    return DaqList(
        name="signals", event_num=0, stim=False, enable_timestamps=True, measurements=measured, priority=0, prescaler=1
    )


def value(master, address):
    """Reads a number."""
    return struct.unpack("<d", master.shortUpload(8, address))[0]


def write(master, address, number):
    """Writes a number."""
    master.setMta(address)
    master.download(struct.pack("<d", number))
