"""Computes eigenvalues with LAPACK, through numpy, and how far each moves with an error in the matrix.

Reads matrices from the file argv[1]: for each matrix, its size as a 64-bit integer, then its rows as 64-bit floats.
Writes to the file argv[2], for each matrix, the real parts, imaginary parts and sensitivities of its eigenvalues as
64-bit floats. The sensitivity is the condition number of the eigenvalue times the norm of the matrix, both of the
balanced matrix. A relative error in the matrix moves the eigenvalue by the sensitivity times that error.
"""

import sys

import numpy


def balanced(matrix):
    """Returns the matrix with its states scaled by powers of two, so that rows and columns have similar norms."""
    exponent = numpy.zeros(len(matrix))
    for _ in range(30):
        scale = 2.0 ** numpy.round(exponent)
        scaled = matrix * scale / scale[:, None]
        off_diagonal = scaled - numpy.diag(numpy.diag(scaled))
        rows = numpy.linalg.norm(off_diagonal, axis=1)
        columns = numpy.linalg.norm(off_diagonal, axis=0)
        used = (rows > 0) & (columns > 0)
        exponent[used] += 0.25 * numpy.log2(rows[used] / columns[used])
    return scaled


data = open(sys.argv[1], "rb").read()
place = 0
with open(sys.argv[2], "wb") as out:
    while place < len(data):
        size = int.from_bytes(data[place : place + 8], "little")
        place += 8
        matrix = balanced(numpy.frombuffer(data, "<f8", size * size, place).reshape(size, size))
        place += 8 * size * size
        values, right = numpy.linalg.eig(matrix)
        left = numpy.linalg.inv(right)
        condition = numpy.linalg.norm(right, axis=0) * numpy.linalg.norm(left, axis=1)
        sensitivity = condition * numpy.linalg.norm(matrix)
        for numbers in (values.real, values.imag, sensitivity):
            out.write(numbers.astype("<f8").tobytes())
