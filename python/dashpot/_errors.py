"""What the package raises: the words of the command `dashpot`, as exceptions."""


class DashpotError(ValueError):
    """A damper, case, study, array or number that is refused: what is wrong, where, and what is allowed there.

    >>> import dashpot
    >>> dashpot.Damper("papr")
    Traceback (most recent call last):
    dashpot.DashpotError: damper `papr`: no such preset or file; give a TOML file or a preset: paper, calibrated, in-service, reduced-vertical, reduced-lateral, the nearest: paper
    """


class DashpotFileError(DashpotError, OSError):
    """A file that cannot be read or written, with the system's reason."""


DashpotError.__module__ = "dashpot"
DashpotFileError.__module__ = "dashpot"
