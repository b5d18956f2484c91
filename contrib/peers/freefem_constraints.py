"""The constraints of the problem of catena_stokes for freefem_stokes.edp:

    freefem_constraints.py DIRECTORY INSTANT

reads places, components and last values of the degrees of freedom and the last
motions of the particles, and writes freefem_constraints.txt: the matrix P by
rows, columns and values, then the known velocities, a first guess and the
reference of the motions. One pressure is zero.
"""

import sys
from pathlib import Path

import numpy as np

from constraints import PRESSURE, Constraints

folder, instant = Path(sys.argv[1]), int(sys.argv[2])
table = np.loadtxt(folder / "freefem_dofs.txt")
motions = table[table[:, 3] < -0.5, 0]
table = table[table[:, 3] > -0.5]
points, components = table[:, :3], np.rint(table[:, 3]).astype(int)

# nodes are told apart on the first mesh
first = folder / "freefem_points.npy"
if instant == 0:
    np.save(first, points)
c = Constraints(folder, np.load(first), components)
P = c.matrix(points, instant)
guess = np.zeros(P.shape[1])
if instant > 0:
    guess = c.first_guess(points, table[:, 4], instant, motions)
pinned = np.flatnonzero(c.kinds == PRESSURE)[0]
guess -= np.where(c.kinds == PRESSURE, guess[pinned], 0.)
kept = np.arange(P.shape[1]) != pinned
P = P[:, kept].tocoo()

with open(folder / "freefem_constraints.txt", "w") as out:
    print(*P.shape, P.nnz, file=out)
    np.savetxt(out, np.column_stack([P.row, P.col, P.data]), "%d %d %.17g")
    np.savetxt(out, c.known(points, instant), "%.17g")
    np.savetxt(out, guess[kept], "%.17g")
    np.savetxt(out, c.reference(instant), "%.17g")
