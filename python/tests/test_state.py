"""States are kept, saved, restored, and stepped by other dampers and by several threads."""

import copy
import pickle
import threading

import dashpot
import numpy
from common import Test

WORDS = "state: another call is stepping it; use one state per thread"


def motion(count, dtype):
    return (8e-3 * numpy.sin(numpy.arange(count) / 90)).astype(dtype)


class States(Test):
    def test_a_copied_state_continues_bit_for_bit(self):
        for dtype in (numpy.float32, numpy.float64):
            built = dashpot.Damper("in-service").build(1e-3, dtype)
            x = motion(2000, dtype)
            state = built.at_rest(x[0])
            built.replay(x[:1000], state=state)
            kept = [copy.copy(state), copy.deepcopy(state), built.state_from_bytes(state.to_bytes()),
                    pickle.loads(pickle.dumps(state))]
            rest = built.replay(x[1000:], state=state)
            for other in kept:
                self.assertNotEqual(other, state)
                self.assertEqual(built.replay(x[1000:], state=other).tobytes(), rest.tobytes())
                self.assertEqual(other, state)

    def test_invalid_state_bytes_are_refused(self):
        built = dashpot.Damper("paper").build()
        saved = built.at_rest(0.1).to_bytes()
        self.assertEqual(saved[:4], b"DAST")
        self.assert_refused("0 bytes, but a saved state has 36", built.state_from_bytes, b"")
        damaged = bytearray(saved)
        damaged[10] ^= 1
        others = (bytes(damaged), b"x" * 36, dashpot.Damper("in-service").build().at_rest().to_bytes(),
                  dashpot.Damper("paper").build(dtype=float).at_rest().to_bytes())
        for bad in others:
            with self.assertRaises(dashpot.DashpotError):
                built.state_from_bytes(bad)
        with self.assertRaises(TypeError):
            built.state_from_bytes("DAST")

    def test_another_damper_takes_the_force_over(self):
        first, second = (dashpot.Damper(name).build() for name in ("paper", "in-service"))
        x = motion(1000, numpy.float32)
        state = first.at_rest(x[0])
        force_n = first.replay(x, state=state)[-1]
        self.assertEqual(state.revision, first.revision)
        after_n = second.step(state, x[-1])
        self.assertIn(dashpot.Status.DAMPER_SWAPPED, state.status)
        self.assertEqual(state.revision, second.revision)
        self.assertLess(abs(after_n - force_n), 0.2 * abs(force_n) + 100.0)
        # The state now belongs to the second damper, and is saved with it.
        self.assertEqual(pickle.loads(pickle.dumps(state)), state)
        with self.assertRaises(dashpot.DashpotError):
            first.state_from_bytes(state.to_bytes())

    def test_a_state_of_another_precision_is_refused(self):
        single, double = (dashpot.Damper("paper").build(dtype=dtype) for dtype in ("f4", "f8"))
        words = "state: wrong precision, allowed: a state of float64, this damper's precision"
        self.assert_refused(words, double.step, single.at_rest(), 0.0)
        self.assert_refused(words, double.replay, numpy.zeros(3), state=single.at_rest())
        words = "states: wrong precision, allowed: states of float64, the precision of the dampers"
        self.assert_refused(words, dashpot.Bank([double]).replay, numpy.zeros((3, 1)), states=[single.at_rest()])

    def test_two_threads_on_one_state_raise_an_error(self):
        built = dashpot.Damper("paper").build()
        x, out = motion(1_000_000, numpy.float32), numpy.empty(1_000_000, numpy.float32)
        told = set()
        for _ in range(200):
            state = built.at_rest()
            out[:] = numpy.nan
            thread = threading.Thread(target=built.replay, args=(x,), kwargs={"state": state, "out": out})
            thread.start()
            while thread.is_alive() and not told:
                if out[0] != out[0]:
                    continue
                for call in (lambda: built.step(state, 0.0), lambda: state.status, state.to_bytes):
                    try:
                        call()
                    except dashpot.DashpotError as error:
                        told.add(str(error))
            thread.join()
            if told:
                break
        self.assertTrue(told)
        self.assertTrue(all(words.startswith("state: another call is stepping it; ") for words in told))
        self.assertEqual(state.force_n, out[-1])

    def test_extreme_displacements_give_finite_forces(self):
        for dtype in ("f4", "f8"):
            built = dashpot.Damper("in-service").build(dtype=dtype)
            for at in (0.0, 1e300, -1e300, float("nan"), float("inf"), 1e-320):
                state = built.at_rest(at)
                for x in (0.0, -0.0, float("nan"), float("-inf"), 1e308, -1e308, 5e-324):
                    self.assertLessEqual(abs(built.step(state, x)), built.force_limit_n)

    def test_a_jump_too_far_restarts_at_rest_there(self):
        built = dashpot.Damper("in-service").build()
        state = built.at_rest(1.0)
        self.assertEqual(state.status, dashpot.Status.INPUT_HELD)
        self.assertEqual(built.step(state, 0.1), 0.0)
        self.assertEqual(state.status, dashpot.Status.INPUT_HELD | dashpot.Status.RESTARTED)
        self.assertEqual(state.rejected_inputs, 2)

    def test_non_numbers_are_refused(self):
        built = dashpot.Damper("paper").build()
        for wrong in ("1", None, [0.0]):
            with self.assertRaises(TypeError):
                built.step(built.at_rest(), wrong)
        with self.assertRaises(TypeError):
            built.step(None, 0.0)
        with self.assertRaises(TypeError):
            dashpot.State()
