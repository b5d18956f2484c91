"""What the figures have in common."""

import math

import matplotlib.pyplot as plt

STYLE = {
    "font.family": "serif",
    "font.serif": ["STIXGeneral"],
    "font.size": 9,
    "mathtext.fontset": "stix",
    "axes.linewidth": 0.6,
    "axes.prop_cycle": plt.cycler(
        color=["#00558c", "#c8502d", "#3c7d4b", "#7a5aa0", "#8c6d1f", "#555555"]),
    "lines.linewidth": 1.1,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "legend.frameon": False,
    "legend.fontsize": 8,
    "svg.fonttype": "none",
    "svg.hashsalt": "catena",
    "savefig.dpi": 200,
}


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return math.nan


def save(figure, name, suffixes=(".svg", ".png")):
    """Write NAME.svg and NAME.png, which do not depend on the date."""
    for suffix in suffixes:
        file = name.with_name(name.name + suffix)
        figure.savefig(file,
                       metadata={"Date": None} if suffix == ".svg" else None)
        print(file)
