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
import scipy.sparse
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py import PETSc

from constraints import PRESSURE, RIGID, Constraints, read_mesh

# The blocks of the system are velocity u, motions of the particles r and
# pressure p. Its preconditioner is block upper triangular, with the pressure's
# mass matrix for the Schur complement; factors 1/2 and 2 of it were no better,
# nor was the lower triangular form. Of the settings of BoomerAMG that were tried
# (thresholds of 0.25 to 0.7, no aggressive coarsening, other smoothers) none
# was faster by more than the times vary.
KRYLOV = {"ksp_type": "fgmres", "ksp_gmres_restart": 200, "ksp_max_it": 500,
          "pc_type": "fieldsplit", "pc_fieldsplit_type": "multiplicative",
          "fieldsplit_r_ksp_type": "preonly",
          "fieldsplit_r_pc_type": "lu",
          "fieldsplit_p_ksp_type": "chebyshev",
          "fieldsplit_p_ksp_max_it": 4,
          "fieldsplit_p_pc_type": "jacobi"}
RESPONSE = {"ksp_type": "cg", "ksp_rtol": 0.1}
BOOMERAMG = {"pc_type": "hypre", "pc_hypre_type": "boomeramg",
             "pc_hypre_boomeramg_coarsen_type": "HMIS",
             "pc_hypre_boomeramg_interp_type": "ext+i",
             "pc_hypre_boomeramg_P_max": 4,
             "pc_hypre_boomeramg_agg_nl": 1,
             "pc_hypre_boomeramg_strong_threshold": 0.5}


def within(prefix, options):
    return {prefix + name: value for name, value in options.items()}


def by_component(prefix):
    return {prefix + "pc_type": "fieldsplit",
            prefix + "pc_fieldsplit_type": "additive",
            **{key: value for c in "xyz" for key, value in within(
                f"{prefix}fieldsplit_{c}_",
                {"ksp_type": "preonly", **BOOMERAMG}).items()}}


SOLVERS = {
    "boomeramg": {**KRYLOV, "fieldsplit_u_ksp_type": "preonly",
                  **within("fieldsplit_u_", BOOMERAMG),
                  **within("u_", {**RESPONSE, **BOOMERAMG})},
    "components": {**KRYLOV, "fieldsplit_u_ksp_type": "preonly",
                   **by_component("fieldsplit_u_"),
                   **within("u_", RESPONSE), **by_component("u_")},
    "gamg": {**KRYLOV, "fieldsplit_u_ksp_type": "preonly",
             "fieldsplit_u_pc_type": "gamg",
             **within("u_", {**RESPONSE, "pc_type": "gamg"})},
    "mumps": {"ksp_type": "fgmres", "ksp_max_it": 100, "pc_type": "lu",
              "pc_factor_mat_solver_type": "mumps"},
}


NAMES = {"boomeramg": "FGMRES, BoomerAMG",
         "components": "FGMRES, BoomerAMG by component", "gamg": "FGMRES, GAMG",
         "mumps": "MUMPS"}


class Clock:
    def __init__(self):
        self.seconds = {}
        self.last = time.process_time()

    def add(self, name):
        now = time.process_time()
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
        clock.add("set_up")
        self.a = fem.form(
            2 * ufl.inner(ufl.sym(ufl.grad(u)), ufl.sym(ufl.grad(v))) * dx)
        self.b = fem.form(-q * ufl.div(u) * dx)
        self.m = fem.form(p * q * dx)
        # compiled once on a machine
        clock.add("compile")
        self.A = fem.petsc.create_matrix(self.a)
        self.B = fem.petsc.create_matrix(self.b)
        self.M = fem.petsc.create_matrix(self.m)
        self.constraints = Constraints(folder, self.points(),
                                       self.components())
        clock.add("set_up")
        n_velocity = 3 * len(self.V.tabulate_dof_coordinates())
        self.n_velocity = n_velocity
        kinds = self.constraints.kinds
        self.columns = {"u": np.flatnonzero(kinds < PRESSURE),
                        "r": np.flatnonzero(kinds == RIGID),
                        "p": np.flatnonzero(kinds == PRESSURE)}
        self.order = np.concatenate(list(self.columns.values()))
        self.K = None

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
        P = petsc_matrix(p[:n, self.columns["u"]])
        Q = petsc_matrix(p[n:, self.columns["p"]])
        known = self.constraints.known(points, instant)
        g = PETSc.Vec().createWithArray(known[:n])
        # few unknowns with many entries in their columns: by products with
        # vectors, as products of matrices would take several times longer
        rigid = p[:n, self.columns["r"]].toarray()
        A_rigid = np.empty_like(rigid)
        B_rigid = np.empty((p.shape[0] - n, rigid.shape[1]))
        for k in range(rigid.shape[1]):
            v = PETSc.Vec().createWithArray(np.ascontiguousarray(rigid[:, k]))
            A_rigid[:, k], B_rigid[:, k] = (self.A * v).array, (self.B * v).array
        f, h = (self.A * g).array, (self.B * g).array
        sparse = scipy.sparse.csr_matrix
        up, pp = p[:n, self.columns["u"]].T, p[n:, self.columns["p"]].T
        ur, pr = sparse(up @ A_rigid), sparse(pp @ B_rigid)
        self.rr = rigid.T @ A_rigid
        h = -pp @ h
        self.rhs = np.concatenate([-up @ f, -rigid.T @ f, h - h.mean()])

        self.K = self.A.PtAP(P, result=self.K)
        self.D = Q.transposeMatMult(self.B.matMult(P))
        self.S = self.M.PtAP(Q)
        DT = PETSc.Mat()
        self.D.transpose(DT)
        self.blocks_of_system = [
            [self.K, petsc_matrix(ur), DT],
            [petsc_matrix(ur.T.tocsr()), petsc_matrix(sparse(self.rr)),
             petsc_matrix(pr.T.tocsr())],
            [self.D, petsc_matrix(pr), None]]
        clock.add("constraints")

    def unknowns(self, x):
        """In the order of the constraints."""
        result = np.zeros(len(self.constraints.kinds))
        result[self.order] = x
        return result

    def blocks(self, x):
        return x[self.order]

    def move(self, folder):
        """Put the vertices where they are a time step later."""
        original = self.domain.geometry.input_global_indices
        self.domain.geometry.x[:] = self.constraints.moved(folder)[original]


def constant_pressure(stokes):
    v = np.zeros(len(stokes.rhs))
    v[-len(stokes.columns["p"]):] = 1.
    vec = PETSc.Vec().createWithArray(v / np.linalg.norm(v))
    return PETSc.NullSpace().create(vectors=[vec])


def with_diagonal(blocks, r, p):
    result = [list(row) for row in blocks]
    result[1][1], result[2][2] = r, p
    return PETSc.Mat().createNest(result)


def system_of(stokes, name):
    blocks = stokes.blocks_of_system
    if name == "mumps":
        # one pressure is taken to be zero, by a diagonal entry
        n = stokes.S.getSize()[0]
        corner = petsc_matrix(scipy.sparse.csr_matrix(
            ([-1.] + [0.] * (n - 1), (range(n), range(n)))))
        return with_diagonal(blocks, blocks[1][1], corner).convert("aij")
    system = PETSc.Mat().createNest(blocks)
    system.setNullSpace(constant_pressure(stokes))
    return system


def split_components(stokes, pc):
    pc.setType("fieldsplit")
    kinds = stokes.constraints.kinds[stokes.columns["u"]]
    pc.setFieldSplitIS(*(
        (name, PETSc.IS().createGeneral(
            np.flatnonzero(kinds == d).astype(PETSc.IntType)))
        for d, name in enumerate("xyz")))


def velocity_solver(stokes, name):
    ksp = PETSc.KSP().create(MPI.COMM_SELF)
    ksp.setOptionsPrefix("u_")
    ksp.setOperators(stokes.K)
    if name == "components":
        split_components(stokes, ksp.getPC())
    ksp.setFromOptions()
    ksp.setUp()
    return ksp


def rigid_schur_complement(stokes, ksp):
    """What resists the motions of the particles if the flow follows them, by
    some iterations each."""
    ur = stokes.blocks_of_system[0][1]
    result = stokes.rr.copy()
    x, b = stokes.K.createVecs()
    unit, y = ur.createVecs()
    for k in range(len(result)):
        unit.set(0.)
        unit[k] = 1.
        unit.assemble()
        ur.mult(unit, b)
        ksp.solve(b, x)
        ur.multTranspose(x, unit)
        result[:, k] -= unit.array
    return (result + result.T) / 2.


def make_solver(stokes, name, tolerance):
    options = PETSc.Options()
    for option, value in SOLVERS[name].items():
        options[option] = value
    ksp = PETSc.KSP().create(MPI.COMM_SELF)
    system = system_of(stokes, name)
    preconditioner = system
    if name != "mumps":
        rigid = rigid_schur_complement(stokes, velocity_solver(stokes, name))
        schur = stokes.S.copy()
        schur.scale(-1.)
        preconditioner = with_diagonal(
            stokes.blocks_of_system,
            petsc_matrix(scipy.sparse.csr_matrix(rigid)), schur)
        u, r, p = preconditioner.getNestISs()[0]
        # upper triangular: the first field is solved for first
        ksp.getPC().setType("fieldsplit")
        ksp.getPC().setFieldSplitIS(("p", p), ("r", r), ("u", u))
    ksp.setOperators(system, preconditioner)
    ksp.setFromOptions()
    ksp.setPCSide(PETSc.PC.Side.RIGHT)
    ksp.setNormType(PETSc.KSP.NormType.UNPRECONDITIONED)
    ksp.setTolerances(rtol=tolerance, atol=0.)
    ksp.setUp()
    if name != "mumps":
        for part in ksp.getPC().getFieldSplitSubKSP():
            if name == "components" and "_u_" in part.getOptionsPrefix():
                split_components(stokes, part.getPC())
            part.setUp()
            if part.getPC().getType() == "fieldsplit":
                for component in part.getPC().getFieldSplitSubKSP():
                    component.setUp()
    return ksp


def solve(ksp, stokes, first_guess):
    b = PETSc.Vec().createWithArray(stokes.rhs)
    x = PETSc.Vec().createWithArray(first_guess)
    ksp.setInitialGuessNonzero(True)
    ksp.solve(b, x)
    if ksp.getConvergedReason() <= 0:
        sys.exit(f"no convergence: {ksp.getConvergedReason()}")
    return x.array


def main():
    folder, name = Path(sys.argv[1]), sys.argv[2]
    clock = Clock()
    stokes = Stokes(folder, clock)
    c = stokes.constraints
    stokes.assemble(0, clock)
    ksp = make_solver(stokes, name, c.problem["tolerance"])
    clock.add("preconditioner")
    x = solve(ksp, stokes, np.zeros(len(stokes.rhs)))
    clock.add("solve")
    iterations = ksp.getIterationNumber()
    motions = c.motions(stokes.unknowns(x), 0)

    # the mesh has moved, the preconditioner is kept
    points = stokes.points()
    total = c.known(points, 0) + stokes.p @ stokes.unknowns(x)
    stokes.move(folder)
    step = Clock()
    stokes.assemble(1, step)
    guess = stokes.blocks(c.first_guess(stokes.points(), total, 1, motions))
    ksp.setOperators(system_of(stokes, name), ksp.getOperators()[1])
    ksp.getPC().setReusePreconditioner(True)
    x = solve(ksp, stokes, guess)
    step.add("solve")
    step_motions = c.motions(stokes.unknowns(x), 1)

    order = [c.rigid.index(r) for r in
             ((1, False, 0), (1, False, 1), (1, True, 2), (0, True, 2))]
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.
    times = clock.seconds
    (folder / f"fenicsx_{name}.json").write_text(json.dumps({
        "code": "FEniCSx", "solver": NAMES[name],
        "cells": stokes.domain.topology.index_map(3).size_local,
        "unknowns": len(c.components),
        "set_up": times["set_up"],
        "assembly": times["assembly"] + times["constraints"],
        "preconditioner": times["preconditioner"],
        "solve": times["solve"], "iterations": iterations,
        "step_assembly": step.seconds["assembly"]
        + step.seconds["constraints"],
        "step_solve": step.seconds["solve"],
        "step_iterations": ksp.getIterationNumber(),
        "memory_MB": memory,
        "motions": list(motions[order]),
        "step_motions": list(step_motions[order])}))


main()
