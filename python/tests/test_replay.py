"""Replay has the bits of the command, copies nothing, releases the GIL, and an interruption leaves the state unchanged."""

import pathlib
import subprocess
import sys
import tempfile
import threading

import dashpot
import numpy
from common import DATA, Test, columns, command
from interruption import interrupted

RIDE = DATA / "excitations" / "ride_made.csv"


def motion(count, dtype=numpy.float32):
    tick = numpy.arange(count)
    return (8e-3 * numpy.sin(tick / 90) + 1e-3 * numpy.sin(tick / 7)).astype(dtype)


class Replay(Test):
    def test_bits_are_those_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            for dtype, scalar in ((numpy.float32, "f32"), (numpy.float64, "f64")):
                for name in ("paper", "in-service", "reduced-vertical"):
                    command("replay", "--damper", name, "--input", RIDE, "--output", "force.csv", "--scalar", scalar,
                            folder=folder)
                    told = columns(pathlib.Path(folder, "force.csv"))
                    x = numpy.array(told["displacement_m"], numpy.float64).astype(dtype)
                    force_n = numpy.array(told["force_n"], numpy.float64).astype(dtype)
                    self.assertGreater(len(x), 1000)
                    mine = dashpot.Damper(name).build(1e-3, dtype).replay(x)
                    self.assertEqual(mine.tobytes(), force_n.tobytes())

    def test_step_by_step_is_the_same(self):
        for dtype in (numpy.float32, numpy.float64):
            built, x = dashpot.Damper("in-service").build(1e-3, dtype), motion(3000, dtype)
            state = built.at_rest(x[0])
            single = numpy.array([built.step(state, one) for one in x], dtype)
            self.assertEqual(built.replay(x).tobytes(), single.tobytes())

    def test_a_motion_in_parts_is_the_same(self):
        built, x = dashpot.Damper("paper").build(), motion(200_000)
        whole, state = built.replay(x), built.at_rest(x[0])
        parts = [built.replay(part, state=state) for part in numpy.split(x, [1, 70_000, 70_000, 150_001])]
        self.assertEqual(whole.tobytes(), numpy.concatenate(parts).tobytes())
        self.assertEqual(state.force_n, whole[-1])
        self.assertAlmostEqual(state.displacement_m, x[-1], 8)

    def test_the_output_array_is_used(self):
        built, x = dashpot.Damper("paper").build(), motion(1000)
        memory = numpy.full(1200, 7, numpy.float32)
        out = memory[100:1100]
        address = out.__array_interface__["data"]
        result = built.replay(x, out=out)
        self.assertIs(result, out)
        self.assertEqual(result.__array_interface__["data"], address)
        self.assertTrue(numpy.shares_memory(result, memory))
        self.assertEqual(out.tobytes(), built.replay(x).tobytes())
        self.assertTrue((memory[:100] == 7).all() and (memory[1100:] == 7).all())

    def test_nothing_is_copied(self):
        # The memory limit allows both arrays and a quarter of one more.
        script = """
import resource
import dashpot, numpy
built = dashpot.Damper("paper").build()
x, out = numpy.zeros((2, 16_000_000), numpy.float32)
out[:] = 1
with open("/proc/self/statm") as file:
    pages = int(file.read().split()[0])
most = pages * resource.getpagesize() + 16_000_000
resource.setrlimit(resource.RLIMIT_AS, (most, most))
try:
    x.copy()
    raise SystemExit("the limit leaves memory for a copy")
except MemoryError:
    pass
assert built.replay(x, out=out) is out and not out.any()
bank = dashpot.Bank([built] * 16)
out[:] = 1
bank.replay(x.reshape(-1, 16), out=out.reshape(-1, 16))
assert not out.any()
"""
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_the_gil_is_released(self):
        # Only a concurrent thread can see a half-finished result.
        built, x = dashpot.Damper("paper").build(), motion(1_000_000)
        bank, wide = dashpot.Bank([built] * 4), motion(1_000_000).reshape(-1, 4)
        for replay, x in ((built.replay, x), (bank.replay, wide)):
            is_half_seen, out = False, numpy.empty_like(x)
            flat = out.reshape(-1)
            for _ in range(200):
                out[:] = numpy.nan
                thread = threading.Thread(target=replay, args=(x,), kwargs={"out": out})
                thread.start()
                while thread.is_alive():
                    is_half_seen |= bool(flat[0] == flat[0] and flat[-1] != flat[-1])
                thread.join()
                self.assertFalse(numpy.isnan(flat).any())
                if is_half_seen:
                    break
            self.assertTrue(is_half_seen)

    def test_an_interruption_ends_it_and_leaves_the_state(self):
        built, x = dashpot.Damper("paper").build(), motion(10_000_000)
        state, out = built.at_rest(0.25), numpy.full(x.shape, numpy.nan, numpy.float32)
        self.assertTrue(interrupted(built.replay, x, state=state, out=out))
        self.assertEqual(state, built.at_rest(0.25))
        self.assertNotEqual(out[-1], out[-1])
        bank, wide = dashpot.Bank([built] * 4), x.reshape(-1, 4)
        states = bank.at_rest()
        self.assertTrue(interrupted(bank.replay, wide, states=states))
        self.assertEqual(states, bank.at_rest())

    def test_two_threads_share_a_damper(self):
        built, x = dashpot.Damper("in-service").build(), motion(100_000)
        expected, forces = built.replay(x).tobytes(), [None] * 4

        def replay(place):
            forces[place] = built.replay(x).tobytes()

        threads = [threading.Thread(target=replay, args=(place,)) for place in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(forces, [expected] * 4)

    def test_bad_input_is_held_or_limited(self):
        built, x = dashpot.Damper("paper").build(), motion(100)
        x[10], x[20], x[30] = numpy.nan, numpy.inf, x[29] + 0.012
        state = built.at_rest(x[0])
        force_n = built.replay(x, state=state)
        self.assertTrue(numpy.isfinite(force_n).all())
        self.assertEqual(state.status & ~dashpot.Status.SATURATED,
                         dashpot.Status.INPUT_HELD | dashpot.Status.INPUT_LIMITED)
        self.assertGreaterEqual(state.rejected_inputs, 3)
        state.clear_status()
        self.assertEqual((state.status, state.rejected_inputs), (dashpot.Status(0), 0))
        bad = numpy.full(10, numpy.nan, numpy.float32)
        self.assertTrue((built.replay(bad) == 0).all())

    def test_an_empty_motion_has_no_forces(self):
        built = dashpot.Damper("paper").build()
        state = built.at_rest(0.5)
        self.assertEqual(built.replay(numpy.empty(0, numpy.float32), state=state).shape, (0,))
        self.assertEqual(state, built.at_rest(0.5))
