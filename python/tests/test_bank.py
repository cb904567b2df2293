"""Compares a bank with its single dampers."""

import copy
import pickle
import threading

import dashpot
import numpy
from common import Test

NAMES = ("paper", "in-service", "reduced-vertical", "calibrated", "reduced-lateral")


def motion(ticks, count, dtype):
    tick, place = numpy.arange(ticks)[:, None], numpy.arange(count)[None, :]
    return (8e-3 * numpy.sin(tick * (1 + place) / 300) + 1e-3).astype(dtype)


class Banks(Test):
    def test_bits_are_those_of_single_dampers(self):
        for dtype in (numpy.float32, numpy.float64):
            for count in (1, 5, 8, 17):
                built = [dashpot.Damper(NAMES[place % 5]).build(1e-3, dtype) for place in range(count)]
                bank, x = dashpot.Bank(built), motion(1000, count, dtype)
                self.assertEqual((len(bank), bank.dtype, bank.step_s), (count, dtype, 1e-3))
                states, alone = bank.at_rest(x[0]), [one.at_rest(at) for one, at in zip(built, x[0])]
                force_n, out = bank.replay(x), numpy.empty_like(x)
                self.assertIs(bank.replay(x, states=states, out=out), out)
                self.assertEqual(force_n.tobytes(), out.tobytes())
                for place, one in enumerate(built):
                    single = one.replay(x[:, place].copy(), state=alone[place])
                    self.assertEqual(single.tobytes(), force_n[:, place].tobytes())
                    self.assertEqual(states[place], alone[place])

    def test_states_continue(self):
        built = [dashpot.Damper(name).build() for name in NAMES]
        bank, x = dashpot.Bank(built), motion(1000, 5, numpy.float32)
        states = bank.at_rest(x[0])
        parts = [bank.replay(x[:400], states=states), bank.replay(x[400:], states=states)]
        self.assertEqual(numpy.concatenate(parts).tobytes(), bank.replay(x).tobytes())

    def test_it_is_a_sequence_of_its_dampers(self):
        built = [dashpot.Damper(name).build() for name in NAMES[:2]] * 2
        bank, x = dashpot.Bank(built), motion(1000, 4, numpy.float32)
        self.assertEqual([id(one) for one in bank], [id(one) for one in built])
        self.assertEqual(repr(bank), f"Bank({built})")
        self.assertIn("BuiltDamper('in-service', step_s=0.001, dtype=float32)", repr(bank))
        for other in (copy.copy(bank), copy.deepcopy(bank), pickle.loads(pickle.dumps(bank))):
            self.assertEqual([one.revision for one in other], [one.revision for one in bank])
            self.assertEqual(other.replay(x).tobytes(), bank.replay(x).tobytes())

    def test_invalid_banks_are_refused(self):
        paper = dashpot.Damper("paper")
        self.assert_refused("dampers: none, allowed: at least one", dashpot.Bank, [])
        mixed = "damper 1: its step or precision differs from that of damper 0, allowed: one step and one precision"
        self.assert_refused(mixed, dashpot.Bank, [paper.build(1e-3), paper.build(2e-3)])
        self.assert_refused(mixed, dashpot.Bank, [paper.build(), paper.build(dtype=float)])
        with self.assertRaises(TypeError):
            dashpot.Bank([paper])

    def test_arrays_that_do_not_fit_are_refused(self):
        bank = dashpot.Bank([dashpot.Damper("paper").build()] * 2)
        x = numpy.zeros((5, 2), numpy.float32)
        self.assert_refused("x: 3 columns, allowed: one for each damper, 2", bank.replay,
                            numpy.zeros((5, 3), numpy.float32))
        self.assert_refused("x: 1 dimensions, allowed: a numpy array of float32 with 2 dimensions", bank.replay, x[0])
        self.assert_refused("states: 1, allowed: one for each damper, 2", bank.replay, x, states=bank.at_rest()[:1])
        self.assert_refused("out: shape [4, 2], allowed: that of x, [5, 2]", bank.replay, x,
                            out=numpy.zeros((4, 2), numpy.float32))
        self.assert_refused("displacements_m: 3 numbers, allowed: one for each damper, 2", bank.at_rest,
                            numpy.zeros(3, numpy.float32))
        fortran = numpy.asfortranarray(numpy.zeros((5, 2), numpy.float32))
        with self.assertRaisesRegex(dashpot.DashpotError, "ascontiguousarray"):
            bank.replay(fortran)
        twice = [bank.at_rest()[0]] * 2
        with self.assertRaises(dashpot.DashpotError):
            bank.replay(x, states=twice)
        self.assertEqual(bank.replay(x[:0]).shape, (0, 2))

    def test_banks_share_dampers_between_threads(self):
        bank, x = dashpot.Bank([dashpot.Damper(name).build() for name in NAMES]), motion(20_000, 5, numpy.float32)
        expected, forces = bank.replay(x).tobytes(), [None] * 3

        def replay(place):
            forces[place] = bank.replay(x).tobytes()

        threads = [threading.Thread(target=replay, args=(place,)) for place in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(forces, [expected] * 3)
