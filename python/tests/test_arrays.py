"""Arrays that cannot be used in place are refused, never copied silently."""

import dashpot
import numpy
from common import Test

SINGLE = "a numpy array of float32 with 1 dimension"
APART = (
    "not contiguous and aligned in memory, allowed: a contiguous and aligned array; use "
    "numpy.ascontiguousarray({0}) or a copy"
)


class Arrays(Test):
    def setUp(self):
        self.built = dashpot.Damper("paper").build()
        self.x = numpy.zeros(100, numpy.float32)

    def test_non_arrays_are_refused(self):
        for wrong, found in (([0.0], "list"), (0.0, "float"), (None, "NoneType"), (numpy.float32(1), "float32")):
            self.assert_refused(f"x: {found}, allowed: {SINGLE}; use numpy.asarray(x, numpy.float32)",
                                self.built.replay, wrong)

    def test_other_dtypes_are_refused(self):
        for dtype in ("float64", "int32", "float16", ">f4", "complex64", "bool", "object"):
            found = numpy.dtype(dtype)
            self.assert_refused(
                f"x: array of {found}, allowed: {SINGLE}; use x.astype(numpy.float32)",
                self.built.replay, numpy.zeros(5, dtype),
            )

    def test_other_dimensions_are_refused(self):
        for shape in ((), (5, 1), (1, 1, 1)):
            self.assert_refused(f"x: {len(shape)} dimensions, allowed: {SINGLE}", self.built.replay,
                                numpy.zeros(shape, numpy.float32))

    def test_non_contiguous_arrays_are_refused(self):
        apart = (self.x[::2], self.x[::-1], numpy.zeros((10, 3), numpy.float32)[:, 1],
                 numpy.broadcast_to(numpy.float32(0), 5),
                 numpy.frombuffer(bytes(41), numpy.uint8)[1:].view(numpy.float32))
        for x in apart:
            self.assert_refused("x: " + APART.format("x"), self.built.replay, x)
            self.built.replay(numpy.array(x))
        self.assert_refused("out: " + APART.format("out"), self.built.replay, self.x[:50], out=self.x[::2])

    def test_output_overlapping_the_input_is_refused(self):
        words = (
            "out: it shares memory with an input array or with an array that another call uses; allowed: separate memory"
        )
        self.assert_refused(words, self.built.replay, self.x, out=self.x)
        self.assert_refused(words, self.built.replay, self.x[:60], out=self.x[40:])
        beside = self.x[:50], self.x[50:]
        self.assertIs(self.built.replay(beside[0], out=beside[1]), beside[1])

    def test_output_sharing_memory_through_another_object_is_refused(self):
        words = (
            "out: it shares memory with an input array or with an array that another call uses; allowed: separate memory"
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

    def test_masked_arrays_are_refused(self):
        masked = numpy.ma.array(self.x, mask=True)
        self.assert_refused(
            "x: a masked array, allowed: a numpy array of float32 with 1 dimension; use x.filled(numpy.nan); at NaN the"
            " step holds its last displacement",
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
