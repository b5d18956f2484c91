"""The problem of catena_stokes in FEniCSx.

    fenicsx_stokes.py DIRECTORY SOLVER

SOLVER is one of SOLVERS. Writes fenicsx_SOLVER.json in the directory.
"""

import json
import resource
import sys
import time
from pathlib import Path

import numpy as np
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py import PETSc

from constraints import PRESSURE, RIGID, Constraints, read_mesh

# Blocks of the system are (velocity with rigid-body motions, pressure). The
# Schur complement is approximated by the pressure's mass matrix; of the
# factors 1/2, 1, 2 tried for it the best one is taken.
KRYLOV = {"ksp_type": "fgmres", "ksp_gmres_restart": 200, "ksp_max_it": 500,
          "pc_type": "fieldsplit", "pc_fieldsplit_type": "multiplicative",
          "fieldsplit_p_ksp_type": "chebyshev",
          "fieldsplit_p_ksp_max_it": 4,
          "fieldsplit_p_pc_type": "jacobi"}
BOOMERAMG = {"pc_type": "hypre", "pc_hypre_type": "boomeramg",
             "pc_hypre_boomeramg_coarsen_type": "HMIS",
             "pc_hypre_boomeramg_interp_type": "ext+i",
             "pc_hypre_boomeramg_P_max": 4,
             "pc_hypre_boomeramg_agg_nl": 1,
             "pc_hypre_boomeramg_strong_threshold": 0.5}


def within(prefix, options):
    return {prefix + name: value for name, value in options.items()}


SOLVERS = {
    "boomeramg": {**KRYLOV, "fieldsplit_u_ksp_type": "preonly",
                  **within("fieldsplit_u_", BOOMERAMG)},
    "gamg": {**KRYLOV, "fieldsplit_u_ksp_type": "preonly",
             "fieldsplit_u_pc_type": "gamg"},
    "mumps": {"ksp_type": "fgmres", "ksp_max_it": 100, "pc_type": "lu",
              "pc_factor_mat_solver_type": "mumps"},
}


class Clock:
    def __init__(self):
        self.seconds = {}
        self.last = time.time()

    def add(self, name):
        now = time.time()
        self.seconds[name] = self.seconds.get(name, 0.) + now - self.last
        self.last = now


def petsc_matrix(p):
    p.sort_indices()
    return PETSc.Mat().createAIJ(
        p.shape, csr=(p.indptr.astype(PETSc.IntType),
                      p.indices.astype(PETSc.IntType), p.data))


class Stokes:
    def __init__(self, folder, clock):
        vertices, cells, *_ = read_mesh(folder / "mesh.msh")
        clock.add("read")
        element = ufl.VectorElement("Lagrange", ufl.tetrahedron, 1)
        self.domain = mesh.create_mesh(MPI.COMM_SELF, cells, vertices,
                                       ufl.Mesh(element))
        self.V = fem.VectorFunctionSpace(self.domain, ("Lagrange", 2))
        self.Q = fem.FunctionSpace(self.domain, ("Lagrange", 1))
        u, v = ufl.TrialFunction(self.V), ufl.TestFunction(self.V)
        p, q = ufl.TrialFunction(self.Q), ufl.TestFunction(self.Q)
        dx = ufl.dx
        self.a = fem.form(
            2 * ufl.inner(ufl.sym(ufl.grad(u)), ufl.sym(ufl.grad(v))) * dx)
        self.b = fem.form(-q * ufl.div(u) * dx)
        self.m = fem.form(p * q * dx)
        self.A = fem.petsc.create_matrix(self.a)
        self.B = fem.petsc.create_matrix(self.b)
        self.M = fem.petsc.create_matrix(self.m)
        clock.add("set_up")
        # the compiler of the forms has its own cache, and reading the mesh
        # in Python is no part of FEniCSx
        self.constraints = Constraints(folder, self.points(),
                                       self.components())
        clock.add("set_up")
        n_velocity = 3 * len(self.V.tabulate_dof_coordinates())
        self.n_velocity = n_velocity
        kinds = self.constraints.kinds
        self.velocity_columns = np.flatnonzero(kinds != PRESSURE)
        self.pressure_columns = np.flatnonzero(kinds == PRESSURE)

    def points(self):
        return np.vstack([np.repeat(self.V.tabulate_dof_coordinates(), 3, 0),
                          self.Q.tabulate_dof_coordinates()])

    def components(self):
        n = len(self.V.tabulate_dof_coordinates())
        return np.concatenate([np.tile([0, 1, 2], n), np.full(
            len(self.Q.tabulate_dof_coordinates()), PRESSURE)])

    def assemble(self, instant, clock):
        for matrix, form in ((self.A, self.a), (self.B, self.b),
                             (self.M, self.m)):
            matrix.zeroEntries()
            fem.petsc.assemble_matrix(matrix, form)
            matrix.assemble()
        clock.add("assembly")
        points, n = self.points(), self.n_velocity
        p = self.constraints.matrix(points, instant)
        self.p = p
        P = petsc_matrix(p[:n, self.velocity_columns])
        Q = petsc_matrix(p[n:, self.pressure_columns])
        known = self.constraints.known(points, instant)
        g = PETSc.Vec().createWithArray(known[:n])
        f, h = P.createVecRight(), Q.createVecRight()
        P.multTranspose(-(self.A * g), f)
        Q.multTranspose(-(self.B * g), h)
        self.K = self.A.PtAP(P)
        self.D = Q.transposeMatMult(self.B.matMult(P))
        self.DT = PETSc.Mat()
        self.D.transpose(self.DT)
        self.S = self.M.PtAP(Q)
        h.shift(-h.sum() / h.getSize())
        self.rhs = np.concatenate([f.array, h.array])
        clock.add("constraints")

    def system(self):
        return PETSc.Mat().createNest([[self.K, self.DT], [self.D, None]])

    def unknowns(self, x):
        """In the order of the constraints."""
        result = np.zeros(len(self.constraints.kinds))
        n = len(self.velocity_columns)
        result[self.velocity_columns] = x[:n]
        result[self.pressure_columns] = x[n:]
        return result

    def blocks(self, x):
        return np.concatenate([x[self.velocity_columns],
                               x[self.pressure_columns]])


def constant_pressure(stokes):
    v = np.zeros(len(stokes.rhs))
    v[len(stokes.velocity_columns):] = 1.
    vec = PETSc.Vec().createWithArray(v / np.linalg.norm(v))
    return PETSc.NullSpace().create(vectors=[vec])


def solver_of(stokes, name, scale):
    options = PETSc.Options()
    for option, value in SOLVERS[name].items():
        options[option] = value
    ksp = PETSc.KSP().create(MPI.COMM_SELF)
    ksp.setFromOptions()
    return ksp


def matrices_for(stokes, name, scale):
    """System and what the preconditioner is made of."""
    system = stokes.system()
    if name == "mumps":
        # one pressure is taken to be zero, by a large diagonal entry
        n = len(stokes.velocity_columns)
        corner = PETSc.Mat().createAIJ(stokes.S.getSize(), nnz=1)
        corner.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)
        for i in range(corner.getSize()[0]):
            corner.setValue(i, i, -1. if i == 0 else 0.)
        corner.assemble()
        whole = PETSc.Mat().createNest([[stokes.K, stokes.DT],
                                        [stokes.D, corner]])
        whole.convert("aij")
        return whole, whole
    schur = stokes.S.copy()
    schur.scale(-scale)
    return system, PETSc.Mat().createNest([[stokes.K, stokes.DT],
                                           [stokes.D, schur]])


def main():
    folder, name = Path(sys.argv[1]), sys.argv[2]
    scale = float(sys.argv[3]) if len(sys.argv) > 3 else 1.
    clock = Clock()
    stokes = Stokes(folder, clock)
    stokes.assemble(0, clock)
    tolerance = stokes.constraints.problem["tolerance"]

    system, preconditioner = matrices_for(stokes, name, scale)
    ksp = solver_of(stokes, name, scale)
    ksp.setOperators(system, preconditioner)
    if name != "mumps":
        sets = preconditioner.getNestISs()[0]
        pc = ksp.getPC()
        pc.setFieldSplitIS(("u", sets[0]), ("p", sets[1]))
        # upper triangular: pressure first
        pc.setFieldSplitIS
        system.setNullSpace(constant_pressure(stokes))
    ksp.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
    ksp.setTolerances(rtol=tolerance, atol=0.)
    ksp.setUp()
    clock.add("preconditioner")

    b = PETSc.Vec().createWithArray(stokes.rhs)
    x = b.duplicate()
    x.set(0.)
    ksp.solve(b, x)
    clock.add("solve")
    iterations = ksp.getIterationNumber()
    reason = ksp.getConvergedReason()
    c = stokes.constraints
    motions = c.motions(stokes.unknowns(x.array), 0)
    print(name, iterations, reason, motions, clock.seconds)


main()
