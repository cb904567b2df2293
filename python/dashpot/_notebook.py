"""Tables and plots of results in notebooks. Plots need matplotlib, which the package does not install."""

import html


def _number(value):
    if value is None:
        return "-"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def table(title, header, rows):
    """Returns an HTML table; every text is escaped, because names come from files."""

    def cells(kind, row):
        return "".join(f"<{kind}>{html.escape(_number(cell))}</{kind}>" for cell in row)

    body = "".join(f"<tr>{cells('td', row)}</tr>" for row in rows)
    return f"<table><caption>{html.escape(title)}</caption><tr>{cells('th', header)}</tr>{body}</table>"


def _damper_html(self):
    return table(self.name, ("key", "value"), self.items())


def _cycle_html(self):
    return table("bench test", ("index", "value"), self.indices.items())


def _calibrated_html(self):
    rows = ((key, value, *self.intervals[key]) for key, value in self.values.items())
    return table("calibrated", ("key", "value", "95 % from", "to"), rows)


def _run_html(self):
    rows = [("ending", self.ending), ("ticks", len(next(iter(self.history.values()), ())))]
    return table(self.case, ("run", ""), [*rows, *(("warning", warning) for warning in self.warnings)])


def axes_for(axes):
    """Returns the axes, or new ones of matplotlib."""
    if axes is not None:
        return axes
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("plot() needs matplotlib: python3 -m pip install matplotlib") from error
    return pyplot.subplots()[1]


def _plot_cycle(self, axes=None):
    """Plots the loop of force over displacement with matplotlib, and returns the axes, new ones by default."""
    axes = axes_for(axes)
    axes.plot(1e3 * self.displacement_m, 1e-3 * self.force_n)
    axes.set_xlabel("displacement, mm")
    axes.set_ylabel("force, kN")
    return axes


def _plot_run(self, *signals, axes=None):
    """Plots columns of the history over time with matplotlib, and returns the axes, new ones by default.

    Without names it plots all columns of `signals`. An unknown name raises `KeyError`.
    """
    names = signals or tuple(name for name in self.history if name not in ("time_s", "distance_m"))
    columns = [self.history[name] for name in names]
    axes = axes_for(axes)
    for name, column in zip(names, columns):
        axes.plot(self.history["time_s"], column, label=name)
    axes.set_xlabel("time, s")
    axes.legend()
    return axes


def attach(damper, cycle, calibrated, run):
    """Gives the classes of the compiled module their tables and plots."""
    for owner, name, function in (
        (damper, "_repr_html_", _damper_html),
        (cycle, "_repr_html_", _cycle_html),
        (calibrated, "_repr_html_", _calibrated_html),
        (run, "_repr_html_", _run_html),
        (cycle, "plot", _plot_cycle),
        (run, "plot", _plot_run),
    ):
        function.__name__, function.__qualname__, function.__module__ = name, f"{owner.__name__}.{name}", "dashpot"
        setattr(owner, name, function)
