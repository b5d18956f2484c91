"""The constraints of the problem of catena_stokes, from the places of the
degrees of freedom alone: they serve every code.

With x the free unknowns, the disturbance of the imposed flow (-y, 0, 0) is
u' = P x + g: zero on walls, without z-component on mirror planes, turned by
half a turn about z at identified nodes, and a rigid motion on each particle,
which is counted against the imposed flow at its centre.
"""

import json
from pathlib import Path

import numpy as np
from scipy.sparse import csr_matrix
from scipy.spatial import cKDTree

# ids of the boundary in the mesh
X_LOW, X_HIGH, Y_LOW, Y_HIGH, Z_LOW, Z_HIGH, PARTICLE = 1, 2, 3, 4, 5, 6, 11
PRESSURE = 3  # component of a degree of freedom, after those of the velocity
RIGID = 4     # kind of an unknown


def read_mesh(path):
    """Vertices, tetrahedra, triangles and their ids of a .msh in version 2.2
    with nothing else."""
    lines = Path(path).read_text().split("\n")
    n = int(lines[4])
    vertices = np.array([l.split()[1:] for l in lines[5:5 + n]], dtype=float)
    begin = 5 + n + 2
    rows = [l.split() for l in lines[begin + 1:begin + 1 + int(lines[begin])]]
    triangles = np.array([r for r in rows if r[1] == "2"], dtype=np.int64)
    cells = np.array([r for r in rows if r[1] == "4"], dtype=np.int64)
    return (vertices, cells[:, 5:] - 1, triangles[:, 5:] - 1, triangles[:, 3])


class Constraints:
    """For degrees of freedom at `points` with the components 0, 1, 2 of the
    velocity or PRESSURE."""

    def __init__(self, folder, points, components):
        self.problem = json.loads((Path(folder) / "problem.json").read_text())
        self.components = components
        vertices, _, triangles, ids = read_mesh(Path(folder) / "mesh.msh")

        places, self.place = np.unique(np.round(points, 9), axis=0,
                                       return_inverse=True)
        tree = cKDTree(places)

        def nodes_on(boundary):
            t = triangles[ids == boundary]
            corners = vertices[np.unique(t)]
            edges = np.vstack([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
            middles = vertices[edges].mean(axis=1)
            distance, index = tree.query(np.vstack([corners, middles]))
            # a space of linear elements has no nodes in the middle
            return np.unique(index[distance < 1e-7])

        n = len(places)
        master = np.arange(n)
        factor = np.ones((n, 4))
        for boundary, x in ((X_LOW, self.problem["lower"][0]),
                            (X_HIGH, self.problem["upper"][0])):
            nodes = nodes_on(boundary)
            image = places[nodes] * [-1, -1, 1] + [2 * x, 0, 0]
            distance, partner = tree.query(image)
            assert distance.max() < 1e-6
            slave = places[nodes, 1] < -1e-9
            master[nodes[slave]] = partner[slave]
            factor[nodes[slave], :2] = -1
            factor[nodes[abs(places[nodes, 1]) < 1e-9], :2] = 0
        for boundary in (Z_LOW, Z_HIGH):
            factor[nodes_on(boundary), 2] = 0
        for boundary in (Y_LOW, Y_HIGH):
            factor[nodes_on(boundary), :3] = 0
        self.particle = np.full(n, -1)
        for i in range(len(self.problem["on_axis"])):
            self.particle[nodes_on(PARTICLE + i)] = i
        factor[self.particle >= 0, :3] = 0
        self.master, self.factor = master, factor

        # unknowns in the order of the degrees of freedom that stand for them
        place, c = self.place, self.components
        free = (master[place] == place) & (factor[place, c] != 0)
        self.kinds = c[free]
        column = np.full((n, 4), -1)
        column[place[free], c[free]] = np.arange(free.sum())
        self.column = column
        self.rigid = []  # (particle, rotation, axis)
        for i, on_axis in enumerate(self.problem["on_axis"]):
            if not on_axis:
                self.rigid += [(i, False, 0), (i, False, 1)]
            self.rigid.append((i, True, 2))
        self.first_rigid = len(self.kinds)
        self.kinds = np.append(self.kinds, [RIGID] * len(self.rigid))

    def on_particle(self, i):
        return (self.particle[self.place] == i) & (self.components < 3)

    def matrix(self, points, instant):
        """P, with the degrees of freedom at `points` now."""
        place, c = self.place, self.components
        columns = self.column[self.master[place], c]
        rows = np.flatnonzero((columns >= 0) & (self.factor[place, c] != 0))
        data = [self.factor[place, c][rows]]
        rows, columns = [rows], [columns[rows]]
        for k, (i, rotation, axis) in enumerate(self.rigid):
            nodes = np.flatnonzero(self.on_particle(i))
            arm = points[nodes] - self.problem["instants"][instant]["centres"][i]
            if rotation:
                unit = np.cross(np.eye(3)[axis], arm)
                value = unit[np.arange(len(nodes)), c[nodes]]
            else:
                value = (c[nodes] == axis).astype(float)
            rows.append(nodes)
            columns.append(np.full(len(nodes), self.first_rigid + k))
            data.append(value)
        return csr_matrix((np.concatenate(data),
                           (np.concatenate(rows), np.concatenate(columns))),
                          shape=(len(c), len(self.kinds)))

    def known(self, points, instant):
        """u_imposed + g at the degrees of freedom, zero for the pressure."""
        c = self.components
        value = np.where(c == 0, -points[:, 1], 0.)
        now = self.problem["instants"][instant]
        for i in range(len(now["centres"])):
            nodes = np.flatnonzero(self.on_particle(i))
            motion = now["velocities"][i] + np.cross(
                now["angular_velocities"][i], points[nodes] - now["centres"][i])
            value[nodes] = motion[np.arange(len(nodes)), c[nodes]]
        return value

    def first_guess(self, points, values, instant, before):
        """Unknowns whose flow is near to the total velocity and pressure
        `values` at the degrees of freedom, with the motions `before`."""
        c, place = self.components, self.place
        masters = np.flatnonzero((self.master[place] == place)
                                 & (self.factor[place, c] != 0))
        x = np.zeros(len(self.kinds))
        disturbance = values - np.where(c == 0, -points[:, 1], 0.)
        x[self.column[place[masters], c[masters]]] = disturbance[masters]
        x[self.first_rigid:] = before - self.reference(instant)
        return x

    def reference(self, instant):
        """What the rigid-body unknowns are counted against."""
        now = self.problem["instants"][instant]
        return np.array([now["angular_velocities" if rotation else "velocities"]
                         [i][axis] for i, rotation, axis in self.rigid])

    def motions(self, x, instant):
        return x[self.first_rigid:] + self.reference(instant)

    def moved(self, folder):
        """Vertices a time step later, in the order of the mesh."""
        return np.loadtxt(Path(folder) / "moved.txt")
