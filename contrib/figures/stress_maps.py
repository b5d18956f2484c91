"""tr(tau)/G on the plane z = 0, from the fields of a run in a quarter of the
box."""

import xml.etree.ElementTree as xml

import matplotlib.pyplot as plt
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_QUADRATIC_TETRA
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from style import number

FIELD = "trace_tau_over_G"
# Corners, then the middles of the edges between them, as VTK has them
FACES = np.array([[0, 1, 2, 4, 5, 6], [0, 1, 3, 4, 8, 7],
                  [1, 2, 3, 5, 9, 8], [0, 2, 3, 6, 9, 7]])
# A curved triangle is drawn as four flat ones
FLAT = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]])


def plane(path):
    """Points, triangles and values on z = 0. The symmetry plane is made of faces
    of the mesh, so that nothing is cut."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfCells() == 0:
        raise SystemExit(f"{path} has no fields that can be read")
    if not grid.GetPointData().HasArray(FIELD):
        raise SystemExit(f"{path} has no {FIELD}: the fluid is not "
                         "viscoelastic")
    if not grid.IsHomogeneous() or grid.GetCellType(0) != VTK_QUADRATIC_TETRA:
        raise SystemExit(f"{path} is not made of quadratic tetrahedra")
    points = vtk_to_numpy(grid.GetPoints().GetData())
    values = vtk_to_numpy(grid.GetPointData().GetArray(FIELD))
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    faces = cells.reshape(-1, 10)[:, FACES].reshape(-1, 6)
    faces = faces[np.all(np.abs(points[faces, 2]) < 1e-5, axis=1)]
    used, faces = np.unique(faces, return_inverse=True)
    triangles = faces.reshape(-1, 6)[:, FLAT].reshape(-1, 3)
    return points[used, :2], triangles, values[used]


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
    figure.colorbar(drawn, ax=list(axes.flat[:len(maps)]), location="bottom",
                    aspect=50, shrink=0.6, label=r"$\mathrm{tr}(\tau)/G$",
                    extend="max")
    return figure, rows
