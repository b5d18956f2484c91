#!/usr/bin/python3
"""Draw the material functions of fluids, from the tables of the program
rheometer: viscosity, normal stress differences and S = N1/(2 sigma_xy) in steady
shear, the extensional viscosity, and the start-up of shear and extension.

    plot_rheometer.py DIRECTORY [MORE ...] [-o NAME]

Writes NAME.svg and NAME.png, by default rheometer in the first directory. A
table that is not there is not drawn; further directories are drawn in dashes
and dots."""

import argparse
import csv
import re
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from style import STYLE, number, save

LINES = ("-", "--", ":", "-.")
RATE = r"rate $/\dot\gamma$"
TIME = r"time $\dot\gamma t$"

# what to draw: table, columns with sign and label, label of the ordinate
PANELS = (
    ("steady_shear", (("viscosity", 1, ""),), r"$\eta/\eta_0$"),
    ("steady_shear", (("N1", 1, "$N_1$"), ("N2", -1, "$-N_2$")),
     r"$N_1,\ -N_2\ \ [\eta_0\dot\gamma]$"),
    ("steady_shear", (("S", 1, ""),), r"$S = N_1/2\sigma_{xy}$"),
    ("steady_extension", (("extensional_viscosity", 1, ""),), r"$\eta_E/\eta_0$"),
    ("start_up_shear", (("viscosity", 1, ""),), r"$\eta^+/\eta_0$"),
    ("start_up_shear", (("N1", 1, ""),), r"$N_1^+\ \ [\eta_0\dot\gamma]$"),
    ("start_up_extension", (("extensional_viscosity", 1, ""),),
     r"$\eta_E^+/\eta_0$"),
)


def read(path):
    """The columns of a table by their names without units."""
    with open(path, newline="") as file:
        rows = [row for row in csv.reader(file) if row]
    if len(rows) < 2:
        raise SystemExit(f"{path}: no rows to draw")
    names = [re.sub(r"\s*\[.*", "", heading) for heading in rows[0]]
    return {name: [number(row[i]) for row in rows[1:]]
            for i, name in enumerate(names)}


def curves(table, columns):
    """Abscissa, ordinate and label of the curves of a table; start-up has one
    for each rate. Curves without a positive value cannot be drawn."""
    rates = list(dict.fromkeys(table["rate"])) if "time" in table else [None]
    for column, sign, label in columns:
        for rate in rates:
            rows = [i for i, r in enumerate(table["rate"]) if rate in (None, r)]
            x = [table["time" if rates[0] else "rate"][i] for i in rows]
            y = [sign * table[column][i] for i in rows]
            if any(value > 0 for value in y):
                yield x, y, label if rate is None else f"rate {rate:g}"


def draw(fluids):
    panels = [(name, columns, ordinate) for name, columns, ordinate in PANELS
              if any(True for _, tables in fluids if name in tables
                     for _ in curves(tables[name], columns))]
    if not panels:
        raise SystemExit("no table of a rheometer found")
    n_columns = min(len(panels), 4)
    n_rows = -(-len(panels) // n_columns)
    figure, axes = plt.subplots(n_rows, n_columns, squeeze=False,
                                layout="constrained",
                                figsize=(2.5 * n_columns, 2.2 * n_rows))
    for axis in axes.flat[len(panels):]:
        axis.remove()

    for axis, (name, columns, ordinate) in zip(axes.flat, panels):
        for f, (fluid, tables) in enumerate(fluids):
            if name not in tables:
                continue
            for c, (x, y, label) in enumerate(curves(tables[name], columns)):
                if len(fluids) > 1:
                    label = f"{label} {fluid}".strip()
                axis.loglog(x, y, label=label or None, color=f"C{c}",
                            linestyle=LINES[f % len(LINES)])
        axis.set_xlabel(TIME if name.startswith("start_up") else RATE)
        axis.set_ylabel(ordinate)
        axis.margins(x=0)
        if axis.get_legend_handles_labels()[0]:
            axis.legend(handlelength=1.6)
    return figure


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", nargs="+", type=Path)
    parser.add_argument("-o", "--output", type=Path, metavar="NAME")
    arguments = parser.parse_args()
    output = arguments.output or arguments.directory[0] / "rheometer"

    names = dict.fromkeys(name for name, _, _ in PANELS)
    fluids = [(directory.resolve().name,
               {name: read(directory / f"{name}.csv") for name in names
                if (directory / f"{name}.csv").is_file()})
              for directory in arguments.directory]

    with plt.rc_context(STYLE):
        save(draw(fluids), output)


main()
