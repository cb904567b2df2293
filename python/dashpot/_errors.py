"""Exceptions of the package, with the messages of the command `dashpot`."""

import os


class DashpotError(ValueError):
    """An invalid damper, case, study, array or number: the message states what is wrong, where, and what is allowed.

    >>> import dashpot
    >>> dashpot.Damper("papr")
    Traceback (most recent call last):
    dashpot.DashpotError: damper `papr`: no such preset or file; give a TOML file or a preset: paper, calibrated, in-service, reduced-vertical, reduced-lateral; did you mean `paper`?
    """


class DashpotKeyError(DashpotError, KeyError):
    """An unknown key of a damper.

    >>> import dashpot
    >>> dashpot.Damper("paper")["mount.clearanse_m"]
    Traceback (most recent call last):
    dashpot.DashpotKeyError: paper: no number at `mount.clearanse_m`; did you mean `mount.clearance_m`?
    """

    def __str__(self):
        return self.args[0]


class DashpotFileError(DashpotError, OSError):
    """A file that cannot be read or written: `filename` is the file, and `errno` is the system's error number, if any.

    >>> import dashpot, errno
    >>> try:
    ...     dashpot.Damper("no/such.toml")
    ... except OSError as error:
    ...     print(error.filename, error.errno == errno.ENOENT)
    no/such.toml True
    """

    def __init__(self, words, errno=None, filename=None):
        super().__init__(words)
        self.errno, self.filename = errno, filename
        self.strerror = None if errno is None else os.strerror(errno)

    def __str__(self):
        return self.args[0]

    def __reduce__(self):
        return type(self), (self.args[0], self.errno, self.filename)


DashpotError.__module__ = "dashpot"
DashpotKeyError.__module__ = "dashpot"
DashpotFileError.__module__ = "dashpot"
