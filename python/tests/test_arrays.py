"""Arrays that cannot be used where they lie are refused, never copied behind the user's back."""

import dashpot
import numpy
from common import Test

SINGLE = "a numpy array of float32 with 1 dimension"
APART = (
    "its numbers do not lie one after the other in memory, allowed: a contiguous and aligned array, as "
    "numpy.ascontiguousarray({0}) or a copy is"
)


class Arrays(Test):
    def setUp(self):
        self.built = dashpot.Damper("paper").build()
        self.x = numpy.zeros(100, numpy.float32)

    def test_what_is_no_array(self):
        for wrong, found in (([0.0], "list"), (0.0, "float"), (None, "NoneType"), (numpy.float32(1), "float32")):
            self.assert_refused(f"x: {found}, allowed: {SINGLE}, as numpy.asarray(x, numpy.float32) makes one",
                                self.built.replay, wrong)

    def test_another_kind_of_number(self):
        for dtype in ("float64", "int32", "float16", ">f4", "complex64", "bool", "object"):
            found = numpy.dtype(dtype)
            self.assert_refused(
                f"x: array of {found}, allowed: {SINGLE}, as x.astype(numpy.float32) makes one",
                self.built.replay, numpy.zeros(5, dtype),
            )

    def test_other_dimensions(self):
        for shape in ((), (5, 1), (1, 1, 1)):
            self.assert_refused(f"x: {len(shape)} dimensions, allowed: {SINGLE}", self.built.replay,
                                numpy.zeros(shape, numpy.float32))

    def test_numbers_apart_in_memory(self):
        apart = (self.x[::2], self.x[::-1], numpy.zeros((10, 3), numpy.float32)[:, 1],
                 numpy.broadcast_to(numpy.float32(0), 5),
                 numpy.frombuffer(bytes(41), numpy.uint8)[1:].view(numpy.float32))
        for x in apart:
            self.assert_refused("x: " + APART.format("x"), self.built.replay, x)
            self.built.replay(numpy.array(x))
        self.assert_refused("out: " + APART.format("out"), self.built.replay, self.x[:50], out=self.x[::2])

    def test_forces_over_the_motion_itself(self):
        words = (
            "out: it shares memory with an array that is read, or that another call uses; allowed: memory of its own"
        )
        self.assert_refused(words, self.built.replay, self.x, out=self.x)
        self.assert_refused(words, self.built.replay, self.x[:60], out=self.x[40:])
        beside = self.x[:50], self.x[50:]
        self.assertIs(self.built.replay(beside[0], out=beside[1]), beside[1])

    def test_forces_over_memory_of_the_motion_by_another_way(self):
        words = (
            "out: it shares memory with an array that is read, or that another call uses; allowed: memory of its own"
        )
        memory = bytearray(4 * 101)
        x = numpy.frombuffer(memory, numpy.float32, 100, 0)
        x[:] = self.x
        for out in (
            numpy.frombuffer(memory, numpy.float32, 100, 4),
            numpy.asarray(memoryview(x)),
            numpy.lib.stride_tricks.as_strided(x),
        ):
            self.assert_refused(words, self.built.replay, x, out=out)
        self.assertTrue(numpy.array_equal(x, self.x))
        wide = x[:, None]
        bank = dashpot.Bank([self.built])
        self.assert_refused(words, bank.replay, wide, out=numpy.frombuffer(memory, numpy.float32, 100, 4)[:, None])

    def test_a_masked_array(self):
        masked = numpy.ma.array(self.x, mask=True)
        self.assert_refused(
            "x: a masked array, allowed: a numpy array of float32 with 1 dimension, as x.filled(numpy.nan) makes one; the step"
            " holds what is NaN",
            self.built.replay,
            masked,
        )
        self.assertEqual(len(self.built.replay(masked.filled(numpy.nan))), 100)

    def test_what_cannot_be_written_to(self):
        out = numpy.zeros(100, numpy.float32)
        out.setflags(write=False)
        self.assert_refused("out: read-only, allowed: an array that can be written to", self.built.replay, self.x,
                            out=out)
        # It can be read.
        self.assertEqual(len(self.built.replay(out)), 100)

    def test_another_length(self):
        self.assert_refused("out: 99 numbers, allowed: as many as x, 100", self.built.replay, self.x,
                            out=numpy.zeros(99, numpy.float32))

    def test_after_an_error_the_arrays_are_free(self):
        out = numpy.zeros(99, numpy.float32)
        for _ in range(3):
            with self.assertRaises(dashpot.DashpotError):
                self.built.replay(self.x, out=out)
        self.built.replay(out, out=self.x[:99])
