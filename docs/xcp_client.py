"""Measures a running vehicle with pyXCP, and gives a damper another clearance.

    dashpot vehicle --case straight-180 --xcp        in one terminal
    python xcp_client.py 127.0.0.1 5555              in another

Writes signals.csv: time from the first row on (us) and the signals below, a row per tick. After 1000 ticks the
clearance becomes 5 mm.
"""

import csv
import re
import struct
import sys
import threading

from pyxcp.config import create_application_from_config
from pyxcp.daq_stim import DaqList, DaqOnlinePolicy
from pyxcp.master import Master

SIGNALS = ["front_lateral_damper_1_force_n", "front_lateral_damper_1_displacement_m", "wheelset_1_left_load_n"]
PARAMETER = "front_lateral_damper_1.mount.clearance_m"
TICKS = 1000


class Rows(DaqOnlinePolicy):
    """Keeps a row of each tick."""

    def __init__(self, daq_lists):
        super().__init__(daq_lists)
        self.rows = []
        self.is_complete = threading.Event()

    def initialize(self):
        pass

    def finalize(self):
        pass

    def on_daq_list(self, daq_list, received_ns, measured_ns, values):
        self.rows.append([measured_ns // 1000, *values])
        if len(self.rows) % TICKS == 0:
            self.is_complete.set()


def addresses(a2l, kind):
    """Addresses of measurements or characteristics of an A2L file."""
    blocks = re.findall(rf"/begin {kind} (\S+) (.*?)/end {kind}", a2l, re.S)
    return {name: int(re.search(r"0x[0-9a-f]+", text).group(), 16) for name, text in blocks}


def main(host, port):
    eth = {"host": host, "port": int(port), "protocol": "TCP", "tcp_nodelay": True}
    application = create_application_from_config({"Transport": {"Eth": eth}})
    application.transport.layer = "ETH"
    with Master("eth", config=application) as master:
        master.connect()
        # Identification 4 is the A2L file.
        a2l = master.identifier(4)
        master.disconnect()
    measured, parameters = addresses(a2l, "MEASUREMENT"), addresses(a2l, "CHARACTERISTIC")
    channels = [(name, measured[name], 0, "F64") for name in SIGNALS]
    policy = Rows([DaqList("signals", 0, False, True, channels, 0, 1)])
    with Master("eth", config=application, policy=policy) as master:
        master.connect()
        policy.setup()
        policy.start()
        policy.is_complete.wait()
        master.setMta(parameters[PARAMETER])
        master.download(struct.pack("<d", 5e-3))
        policy.is_complete.clear()
        policy.is_complete.wait()
        policy.stop()
        master.disconnect()
    with open("signals.csv", "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["time_us", *(name for name, *_ in policy.daq_lists[0].headers)])
        rows.writerows(policy.rows)
    print(f"{len(policy.rows)} ticks of {len(SIGNALS)} signals; {PARAMETER} = 5e-3 from about tick {TICKS} on")


if __name__ == "__main__":
    main(*sys.argv[1:])
