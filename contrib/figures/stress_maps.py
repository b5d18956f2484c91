"""tr(tau)/G on the plane z = 0, from the fields of a run in a quarter of the
box."""

import base64
import xml.etree.ElementTree as xml
import zlib

import matplotlib.pyplot as plt
import numpy as np

from style import number

TYPES = {"Float32": np.float32, "Float64": np.float64, "Int32": np.int32,
         "Int64": np.int64, "UInt8": np.uint8}
FIELD = "trace_tau_over_G"
QUADRATIC_TETRAHEDRON = 24
# Corners, then the middles of the edges between them, as VTK has them
FACES = np.array([[0, 1, 2, 4, 5, 6], [0, 1, 3, 4, 8, 7],
                  [1, 2, 3, 5, 9, 8], [0, 2, 3, 6, 9, 7]])
# A curved triangle is drawn as four flat ones
FLAT = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])


def array(element):
    """Values of a DataArray: a header with the number of blocks, the size of a
    block and of the last one, and the compressed sizes; then the blocks."""
    text = element.text.strip()
    n_blocks = int(np.frombuffer(base64.b64decode(text[:8])[:4], "<u4")[0])
    # base64 has four characters for three bytes
    length = -(-4 * (3 + n_blocks) // 3) * 4
    sizes = np.frombuffer(base64.b64decode(text[:length]), "<u4")[3:3 + n_blocks]
    body, begin, blocks = base64.b64decode(text[length:]), 0, []
    for size in sizes:
        blocks.append(zlib.decompress(body[begin:begin + size]))
        begin += size
    values = np.frombuffer(b"".join(blocks), TYPES[element.get("type")])
    n = int(element.get("NumberOfComponents", 1))
    return values.reshape(-1, n) if n > 1 else values


def plane(path):
    """Points, triangles and values on z = 0. The symmetry plane is made of faces
    of the mesh, so that nothing is cut."""
    points, triangles, values = [], [], []
    n = 0
    for piece in xml.parse(path).getroot().iter("Piece"):
        by_name = {e.get("Name"): e for e in piece.iter("DataArray")}
        if FIELD not in by_name:
            raise SystemExit(f"{path} has no {FIELD}: the fluid is not "
                             "viscoelastic")
        if np.any(array(by_name["types"]) != QUADRATIC_TETRAHEDRON):
            raise SystemExit(f"{path} is not made of quadratic tetrahedra")
        place = array(piece.find("Points/DataArray"))
        cells = array(by_name["connectivity"]).reshape(-1, 10)
        faces = cells[:, FACES].reshape(-1, 6)
        faces = faces[np.all(np.abs(place[faces, 2]) < 1e-5, axis=1)]
        used, faces = np.unique(faces, return_inverse=True)
        triangles.append(n + faces.reshape(-1, 6)[:, FLAT].reshape(-1, 3))
        points.append(place[used, :2])
        values.append(array(by_name[FIELD])[used])
        n += len(used)
    return map(np.concatenate, (points, triangles, values))


def fields(run):
    """Strain and file of the fields a run has written."""
    record = run.results / "fields.pvd"
    if not record.exists():
        return []
    return [(float(e.get("timestep")), run.results / e.get("file"))
            for e in xml.parse(record).getroot().iter("DataSet")]


def gap_centre(run, strain):
    """The point between the first particle and its neighbour."""
    row = min(run.rows(), key=lambda r: abs(number(r["strain"]) - strain))
    first = np.array([number(row["x_0"]), number(row["y_0"])])
    if run.program == "two_particles":
        # the neighbour is the image of the first one
        return 0. * first
    return (first + [number(row["x_1"]), number(row["y_1"])]) / 2.


def draw_one(axis, path, centre, half_size, largest_shown):
    """A map. Returns it and the largest value it has."""
    points, triangles, values = plane(path)
    half_size = np.array(half_size)
    largest = -np.inf
    # the quarter and its image by half a turn
    for sign in (1., -1.):
        place = sign * points - centre
        corners = place[triangles]
        seen = np.all((corners.min(axis=1) < half_size) &
                      (corners.max(axis=1) > -half_size), axis=1)
        if not seen.any():
            continue
        drawn = axis.tripcolor(
            sign * points[:, 0], sign * points[:, 1], triangles[seen], values,
            shading="gouraud", cmap="inferno", vmin=0., vmax=largest_shown,
            rasterized=True)
        largest = max(largest, values[triangles[seen]].max())
    # what has no fluid is a particle
    axis.set_facecolor("0.75")
    axis.set_aspect("equal")
    for limits, c, h in zip((axis.set_xlim, axis.set_ylim), centre, half_size):
        limits(c - h, c + h)
    return drawn, largest


def draw(maps, half_size, largest_shown, n_columns):
    """A figure of maps, each one a title, a run, a strain, a file and whether its
    centre is the gap, and the rows of a table with the largest values."""
    n_rows = -(-len(maps) // n_columns)
    width = 6.6 / n_columns
    figure, axes = plt.subplots(
        n_rows, n_columns, squeeze=False, layout="constrained",
        figsize=(6.6, 0.7 + n_rows * (0.3 + width * half_size[1] / half_size[0])))
    rows = []
    for axis, (title, run, strain, path, at_gap) in zip(axes.flat, maps):
        centre = gap_centre(run, strain) if at_gap else np.zeros(2)
        drawn, largest = draw_one(axis, path, centre, half_size, largest_shown)
        axis.set_title(f"{title}: largest {largest:.1f}", fontsize=8)
        rows.append({"map": title, "strain": f"{strain:g}",
                     "largest tr(tau)/G": f"{largest:.2f}"})
    for axis in axes[-1]:
        axis.set_xlabel("$x/a$")
    for axis in axes[:, 0]:
        axis.set_ylabel("$y/a$")
    for axis in axes.flat[len(maps):]:
        axis.remove()
    figure.colorbar(drawn, ax=list(axes.flat[:len(maps)]), location="bottom", aspect=50, shrink=0.6,
                    label=r"$\mathrm{tr}(\tau)/G$", extend="max")
    return figure, rows
