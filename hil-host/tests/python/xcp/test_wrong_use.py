"""What the server answers to masters that do something wrong, and who is not answered."""

import socket
import struct
import unittest

from pyxcp.types import XcpResponseError

from running import Collected, Vehicle, daq_list, master, uploaded, value, write

PARAMETER = "front_vertical_damper_1.mount.clearance_m"


class WrongUse(unittest.TestCase):
    def refused(self, expected, command, *arguments):
        with self.assertRaises(XcpResponseError) as found:
            command(*arguments)
        self.assertEqual(str(found.exception.get_error_code()), f"ERR_{expected}")

    def test_error_codes(self):
        with Vehicle("--duration-s", "0.1") as vehicle, master(vehicle.port) as xcp:
            a2l = uploaded(xcp)
            parameter, measured = a2l.parameters[PARAMETER], a2l.measured["time_s"]
            before = value(xcp, parameter)
            self.refused("OUT_OF_RANGE", write, xcp, parameter, -1.0)
            self.refused("OUT_OF_RANGE", write, xcp, parameter, float("nan"))
            self.refused("OUT_OF_RANGE", write, xcp, parameter, 1e9)
            self.refused("WRITE_PROTECTED", write, xcp, measured, 1.0)
            self.refused("ACCESS_DENIED", value, xcp, 0x4000_0000)
            self.refused("PAGE_NOT_VALID", xcp.setCalPage, 0x83, 0, 2)
            self.refused("SEGMENT_NOT_VALID", xcp.getCalPage, 0x01, 1)
            self.refused("CMD_UNKNOWN", xcp.getSeed, 0, 1)
            xcp.freeDaq()
            self.refused("SEQUENCE", xcp.allocOdt, 0, 1)
            xcp.allocDaq(1)
            self.refused("OUT_OF_RANGE", xcp.allocOdt, 1, 1)
            self.refused("MEMORY_OVERFLOW", xcp.allocDaq, 64)
            self.refused("DAQ_CONFIG", xcp.startStopDaqList, 1, 0)
            self.assertEqual(value(xcp, parameter), before)

    def test_a_second_master_is_not_answered(self):
        with Vehicle("--duration-s", "0.1") as vehicle, master(vehicle.port) as xcp:
            with socket.create_connection(("127.0.0.1", vehicle.port)) as other:
                other.sendall(bytes([2, 0, 0, 0, 0xFF, 0]))
                # The server has read it before it answers the first master again.
                for _ in range(3):
                    self.assertEqual(xcp.getStatus().sessionStatus.daqRunning, False)
                other.setblocking(False)
                self.assertRaises(BlockingIOError, other.recv, 1)
            other = socket.create_connection(("127.0.0.1", vehicle.port))
            # This is none of the protocol, and the connection is closed.
            other.sendall(b"GET / HTTP/1.1\r\n\r\n")
            other.settimeout(60)
            self.assertEqual(other.recv(1), b"")
            other.close()
            self.assertEqual(xcp.getStatus().sessionStatus.daqRunning, False)

    def test_on_an_address_of_the_network_nothing_can_be_calibrated(self):
        with Vehicle("--duration-s", "0.1", address="0.0.0.0:0") as vehicle:
            self.assertIn("read-only", vehicle.notes[-1])
            a2l = vehicle.a2l()
            collected = Collected([daq_list(a2l, ["time_s"])])
            with master(vehicle.port, policy=collected) as xcp:
                self.assertFalse(xcp.slaveProperties.supportsCalpag)
                self.assertEqual(uploaded(xcp).parameters, {})
                self.refused("ACCESS_DENIED", write, xcp, 0x2000_0000, 1.0)
                self.refused("SEGMENT_NOT_VALID", xcp.setCalPage, 0x83, 0, 1)
                collected.setup()
                collected.run_until(100)
            self.assertEqual(vehicle.end()["xcp"]["is_read_only"], True)
        times_s = [sample[0] for sample in collected.samples]
        self.assertEqual(times_s, [tick / 1000 for tick in range(1, 101)])

    def test_a_master_that_is_gone_leaves_the_vehicle_where_it_was(self):
        with Vehicle("--duration-s", "0.5") as vehicle:
            a2l = vehicle.a2l()
            lost = Collected([daq_list(a2l, ["time_s"])])
            with self.assertRaises(ConnectionError):
                with master(vehicle.port, policy=lost):
                    lost.setup()
                    lost.run_until(50)
                    # Not disconnected.
                    raise ConnectionError
            collected = Collected([daq_list(a2l, ["time_s"])])
            first = round(1000 * lost.samples[-1][0]) + 1
            with master(vehicle.port, policy=collected):
                collected.setup()
                collected.run_until(501 - first)
            self.assertEqual(vehicle.end()["xcp"]["sessions"], 2)
        times_s = [sample[0] for sample in collected.samples]
        self.assertEqual(times_s, [tick / 1000 for tick in range(first, 501)])

    def test_several_messages_in_a_datagram(self):
        with Vehicle("--duration-s", "0.1") as vehicle:
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
                other.settimeout(60)
                other.connect(("127.0.0.1", vehicle.port))
                # CONNECT, GET_STATUS, and a header without its packet; then DISCONNECT.
                messages = [b"\xff\x00", b"\xfd"]
                sent = b"".join(struct.pack("<HH", len(packet), 0) + packet for packet in messages)
                other.send(sent + b"\xff\xff\x00\x00")
                self.assertEqual(other.recv(2000)[4], 0xFF)
                self.assertEqual(other.recv(2000)[2:5], b"\x01\x00\xff")
                other.send(b"\x01\x00\x02\x00\xfe")
                self.assertEqual(other.recv(2000)[2:], b"\x02\x00\xff")


if __name__ == "__main__":
    unittest.main()
