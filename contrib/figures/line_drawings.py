"""Curves in panels."""

import math

import matplotlib.pyplot as plt

from style import number

COLOURS = plt.get_cmap("viridis")


def colours(labels):
    """One for each label: black for the Newtonian fluid, the rest in a row from
    dark to light."""
    others = [l for l in labels if l != "Newtonian"]
    result = {"Newtonian": "black"}
    for i, label in enumerate(others):
        result[label] = COLOURS(0.9 * i / max(1, len(others) - 1))
    return result


def in_words(label):
    """Greek letters and subscripts of the labels."""
    for word, symbol in (("lambda_c gamma", r"$\lambda_c\dot\gamma$"),
                         ("d_min", r"$d_\mathrm{min}$"),
                         ("alpha", r"$\alpha$"), ("beta", r"$\beta$"),
                         ("dt", r"$\Delta t\dot\gamma$")):
        label = label.replace(word, symbol)
    return label


def grid(n_panels, n_quantities):
    """Rows and columns of the panels; a single row or column is folded."""
    if min(n_panels, n_quantities) > 1:
        return n_quantities, n_panels
    n = max(n_panels, n_quantities)
    n_columns = 2 if n in (2, 4) else min(n, 3)
    return -(-n // n_columns), n_columns


def value(row, column):
    """A number that is drawn: there is no force where there is no contact."""
    if column == "F_r" and number(row["held_contacts"]) == 0.:
        return math.nan
    return number(row[column])


def draw(curves, abscissa, quantities, scale="linear"):
    """A figure with a panel for each quantity and each panel of the curves. A
    quantity is a column, its label and the range shown, if not all."""
    panels = list(dict.fromkeys(c.panel for c in curves))
    n_rows, n_columns = grid(len(panels), len(quantities))
    figure, axes = plt.subplots(
        n_rows, n_columns, squeeze=False, sharex=True, layout="constrained",
        figsize=(6.6 if n_columns > 1 else 3.6, 0.6 + 2. * n_rows))
    cells = [(q, p) for q in quantities for p in panels]
    for axis, ((column, label, limits), panel) in zip(axes.flat, cells):
        of_panel = [c for c in curves if c.panel == panel]
        colour = colours([c.label for c in of_panel])
        for curve in of_panel:
            # not the start-up, at negative strains
            rows = [r for r in curve.run.rows() if number(r[abscissa[0]]) >= 0.]
            if not rows:
                continue
            axis.plot([number(r[abscissa[0]]) for r in rows],
                      [value(r, column) for r in rows],
                      label=in_words(curve.label), color=colour[curve.label],
                      linestyle="--" if curve.label == "Newtonian" else "-")
        axis.set_xscale(scale)
        axis.set_yscale(scale)
        axis.set_ylabel(label)
        if limits:
            axis.set_ylim(limits)
        axis.margins(x=0)
        axis.set_title(in_words(panel), fontsize=9)
    for axis in axes[-1]:
        axis.set_xlabel(abscissa[1])
    for axis in axes.flat[len(cells):]:
        axis.remove()
    explained = []
    for axis in axes.flat[:len(cells)]:
        labels = axis.get_legend_handles_labels()[1]
        if labels and labels not in explained:
            axis.legend(handlelength=1.4, fontsize=7, labelspacing=0.2)
            explained.append(labels)
    return figure
