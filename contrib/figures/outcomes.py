"""What trajectories come to, as tables."""

from cases import MESHES

# The columns of thinned tables: what a program calls them, their name, digits
COLUMNS = {
    "trajectory": (("strain", "strain", 5), ("theta", "theta [deg]", 5),
                   ("gap", "gap [2a]", 4), ("omega_0", "omega_0 [gamma]", 5),
                   ("omega_1", "omega_1 [gamma]", 5), ("F_r", "F_r [F_S]", 4)),
    "steady_shear": (("rate", "rate", 5), ("viscosity", "viscosity [eta0]", 6),
                     ("S", "S", 6)),
}
INTERVAL = 0.5

# A string is constant if it turns by less, in degrees in a unit of strain, over
# the last strains. A new mesh moves theta by a hundredth of a degree.
CONSTANT = 0.01
LAST_STRAINS = 5.


def column(rows, name):
    return [float(row[name] or "nan") for row in rows]


def mesh_name(run):
    mesh = tuple(int(run.values[f"Mesh/Elements {where}"])
                 for where in ("on equator", "across gap"))
    names = {size: name for name, size in MESHES.items()}
    return names.get(mesh, "{} / {}".format(*mesh))


def growth(rows):
    """Slope of the straight line through theta over the last strains."""
    end = float(rows[-1]["strain"])
    last = [r for r in rows
            if float(r["strain"]) >= max(0., end - LAST_STRAINS)]
    x, y = column(last, "strain"), column(last, "theta")
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    square = sum((a - mean_x) ** 2 for a in x)
    if square == 0.:
        return 0.
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / square


def verdict(run, rows):
    """A run aligns if theta is constant or falls at its end, else it passes,
    and is still about to if theta has not grown beyond 90 degrees."""
    if run.state() != "complete":
        return f"ended at strain {float(rows[-1]['strain']):.1f}"
    if max(column(rows, "theta")) > 90.:
        return "passed"
    return "aligned" if growth(rows) <= CONSTANT else "passing"


def outcome(curve):
    run, rows = curve.run, curve.run.rows()
    result = {"panel": curve.panel, "curve": curve.label}
    if not rows:
        return {**result, "outcome": "not run"}
    last = rows[-1]
    three = run.program == "three_particles"
    result.update({
        "outcome": verdict(run, rows),
        "theta [deg]": f"{float(last['theta']):.2f}",
        "growth of theta [deg/strain]": f"{growth(rows):.3f}",
        **({"omega of middle [gamma]": f"{float(last['omega_0']):.4f}",
            "omega of outer [gamma]": f"{float(last['omega_1']):.4f}"}
           if three else {"omega [gamma]": f"{float(last['omega_0']):.4f}"}),
        "F_r [F_S]": f"{float(last['F_r']):.4f}"
                     if float(last["held_contacts"]) else "",
        "gap [2a]": f"{float(last['gap']):.3g}",
        "mesh": mesh_name(run),
        "elements": last["elements"],
        "new meshes": str(sum(r["remeshed"] == "1" for r in rows)),
        "steps": str(len(rows) - 1),
        "seconds": f"{run.seconds():.0f}"})
    return result


def filled(rows):
    """The rows with the same columns, of which none is empty."""
    names = list(dict.fromkeys(n for row in rows for n in row))
    names = [n for n in names if any(row.get(n) for row in rows)]
    return [{n: row.get(n, "") for n in names} for row in rows]


def markdown(rows):
    lines = [list(rows[0]), ["---"] * len(rows[0]), *(r.values() for r in rows)]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def thinned(rows):
    """The first row, the first one after each interval of strain, the last."""
    kept, due = [], float("-inf")
    for row in rows:
        strain = float(row["strain"])
        if strain >= due - 1e-6 or row is rows[-1]:
            kept.append(row)
            due = INTERVAL * (int(strain // INTERVAL) + 1)
    return kept


def cell(row, name, digits):
    value = float(row.get(name) or "nan")
    if value != value or (name == "F_r" and float(row["held_contacts"]) == 0):
        return ""
    return f"{value:.{digits}g}"


def thinned_curves(curves):
    """One table of all curves."""
    result = []
    for curve in curves:
        rows = curve.run.rows()
        if curve.run.length():
            rows = thinned(rows)
        for row in rows:
            result.append({"panel": curve.panel, "curve": curve.label, **{
                name: cell(row, column, digits)
                for column, name, digits in COLUMNS[curve.run.table.stem]}})
    return result
