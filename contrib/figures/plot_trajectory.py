#!/usr/bin/python3
"""Draw trajectories: the angle, the angular velocities, the gap and the force
that holds it against strain.

    plot_trajectory.py trajectory.csv [MORE.csv ...] [-o NAME]

Writes NAME.svg and NAME.png, by default beside the first table. Columns are
found by name; a unit may follow it in brackets, as in `theta [deg]`. A column
that is not there is not drawn. Negative strain is the start-up."""

import argparse
import csv
import math
import re
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from style import STYLE, number, save

# what to draw: pattern of the columns, label of the axis, label of a curve
PANELS = (
    (r"theta(_deg)?", r"$\theta$ [deg]", r"$\theta_{{{}}}$"),
    (r"omega(_z)?(_?\d+|_[a-z]+)?", r"$\omega/\dot\gamma$", r"$\omega_\mathrm{{{}}}$"),
    (r"(minimal_)?gap(_over_2a)?(_?\d+)*", r"gap$/2a$", r"gap {}"),
    (r"F_?r(_?\d+)*", r"$F_r/F_S$", r"$F_{{r,{}}}$"),
)


def read(path):
    """The columns of a table by their names without units: theta in degrees,
    gaps in 2a."""
    with open(path, newline="") as file:
        rows = [r for r in csv.reader(file) if r and not r[0].startswith("#")]
    if len(rows) < 2:
        raise SystemExit(f"{path}: no rows to draw yet")
    # a run that is under way may have written half of its last row
    body = [r for r in rows[1:] if len(r) == len(rows[0])]
    table = {}
    for i, heading in enumerate(rows[0]):
        name, unit = re.fullmatch(r"\s*(.*?)\s*(?:[\[(](.*)[\])])?\s*", heading).groups()
        factor = 1
        if "theta" in name and unit == "rad":
            factor = 180 / math.pi
        elif "gap" in name and unit == "a":
            factor = 0.5
        table[name] = [factor * number(row[i]) for row in body]
    return table


def curves(table, pattern):
    """Label and values of the columns that match and hold a number."""
    for name, values in table.items():
        if re.fullmatch(pattern, name) and not all(map(math.isnan, values)):
            index = re.search(r"_?(\d+(_\d+)*|middle|outer)$", name)
            yield (index.group(1).replace("_", ",") if index else ""), values


def draw(tables):
    panels = [p for p in PANELS
              if any(True for _, t in tables for _ in curves(t, p[0]))]
    if not panels:
        raise SystemExit("none of the columns theta, omega, gap, F_r found")
    figure, axes = plt.subplots(
        len(panels), sharex=True, squeeze=False, layout="constrained",
        figsize=(3.4, 0.5 + 1.35 * len(panels)))
    axes = axes[:, 0]
    start = min(min(table["strain"]) for _, table in tables)

    for axis, (pattern, label, curve_label) in zip(axes, panels):
        drawn = 0
        for t, (name, table) in enumerate(tables):
            for c, (index, values) in enumerate(curves(table, pattern)):
                text = curve_label.format(index) if index else ""
                if len(tables) > 1:
                    text = f"{text} {name}".strip()
                axis.plot(table["strain"], values, label=text or None,
                          color=f"C{t if len(tables) > 1 else c}",
                          linestyle=("-", "--", ":", "-.")[
                              c % 4 if len(tables) > 1 else 0])
                drawn += 1
        axis.set_ylabel(label)
        axis.margins(x=0)
        axis.locator_params(axis="y", nbins=5)
        if start < 0:
            axis.axvspan(start, 0, color="0.93", linewidth=0, zorder=0)
        if drawn > 1:
            axis.legend(ncols=2, handlelength=1.6, columnspacing=1)
    axes[-1].set_xlabel(r"strain $\dot\gamma t$" +
                        (" (start-up shaded)" if start < 0 else ""))
    figure.align_ylabels(axes)
    return figure


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", nargs="+", type=Path)
    parser.add_argument("-o", "--output", type=Path, metavar="NAME")
    arguments = parser.parse_args()
    output = arguments.output or arguments.table[0].with_suffix("")

    tables = []
    for path in arguments.table:
        table = read(path)
        if "strain" not in table:
            raise SystemExit(f"{path}: no column 'strain'")
        tables.append((path.resolve().parent.name, table))

    with plt.rc_context(STYLE):
        figure = draw(tables)
        save(figure, output)


main()
