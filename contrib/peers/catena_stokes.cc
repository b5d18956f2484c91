/**
 * The problem that contrib/peers/run gives to several codes, and Catena's
 * solution of it: three free particles at the smallest gap in a sheared
 * Newtonian fluid, in a quarter of the box, and the same a time step later.
 *
 *   catena_stokes N_PART N_MIN TOLERANCE DIRECTORY
 *
 * writes in DIRECTORY
 *
 * - mesh.msh: a mesh with straight edges, which all codes can read,
 * - moved.txt: where its vertices are a time step later,
 * - problem.json: box, particles and imposed motions,
 * - catena.json: what it took, and the motions of the particles.
 */

#include <catena/flow/flow_solver.h>
#include <catena/flow/velocity_constraints.h>
#include <catena/mesh/mesh_mover.h>
#include <catena/mesh/mesher.h>
#include <catena/scene/line_of_particles.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fstream>
#include <iomanip>
#include <iostream>
#include <string>

#include "../benchmarks/cpu_seconds.h"

using namespace dealii;
using namespace Catena;

namespace
{
  constexpr double minimal_gap = 0.02, time_step = 0.08;

  /// Put the mid-nodes in the middle of their edges, also on the particles.
  VectorType
  straightened(const MovingMesh<3> &mesh, const VectorType &positions)
  {
    VectorType result = positions;
    for (const auto node : mesh.owned_nodes())
      {
        const auto &ends = mesh.edge_ends(node);
        for (unsigned int d = 0; d < 3; ++d)
          result(3 * node + d) =
            (positions(3 * ends[0] + d) + positions(3 * ends[1] + d)) / 2.;
      }
    result.update_ghost_values();
    return result;
  }



  void
  write_vertices(std::ostream        &out,
                 const MovingMesh<3> &mesh,
                 const VectorType    &positions,
                 const bool           numbered)
  {
    out << std::setprecision(17);
    for (const auto vertex : mesh.owned_scalars())
      {
        const unsigned int node = mesh.node_of_vertex(vertex);
        if (numbered)
          out << vertex + 1 << ' ';
        out << positions(3 * node) << ' ' << positions(3 * node + 1) << ' '
            << positions(3 * node + 2) << '\n';
      }
  }



  /// In version 2.2 of gmsh's format.
  void
  write_mesh(const std::string &path, const MovingMesh<3> &mesh)
  {
    std::vector<std::array<unsigned int, 4>> faces;
    for (const auto &cell : mesh.cells())
      for (const unsigned int f : cell.iterator->face_indices())
        if (cell.iterator->face(f)->at_boundary())
          {
            std::array<unsigned int, 4> face;
            face[3] = cell.iterator->face(f)->boundary_id();
            for (unsigned int k = 0; k < 3; ++k)
              for (unsigned int v = 0; v < 4; ++v)
                if (cell.iterator->vertex_index(v) ==
                    cell.iterator->face(f)->vertex_index(k))
                  face[k] = cell.vertices[v];
            faces.push_back(face);
          }

    std::ofstream out(path);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
        << mesh.owned_scalars().n_elements() << '\n';
    write_vertices(out, mesh, mesh.positions(), true);
    out << "$EndNodes\n$Elements\n"
        << faces.size() + mesh.cells().size() << '\n';
    // physical groups count from 1
    unsigned int n = 0;
    for (const auto &face : faces)
      out << ++n << " 2 2 " << face[3] + 1 << ' ' << face[3] + 1 << ' '
          << face[0] + 1 << ' ' << face[1] + 1 << ' ' << face[2] + 1 << '\n';
    for (const auto &cell : mesh.cells())
      {
        out << ++n << " 4 2 100 100";
        for (const unsigned int vertex : cell.vertices)
          out << ' ' << vertex + 1;
        out << '\n';
      }
    out << "$EndElements\n";
  }



  void
  write_configuration(std::ostream           &out,
                      const Scene<3>         &scene,
                      const Configuration<3> &configuration)
  {
    const auto reference = reference_motions<3>(scene, configuration, false);
    const auto list      = [&](const std::string &name, const auto &entry) {
      out << "    \"" << name << "\": [";
      for (unsigned int i = 0; i < configuration.centres.size(); ++i)
        {
          const Tensor<1, 3> v = entry(i);
          out << (i > 0 ? ", [" : "[") << v[0] << ", " << v[1] << ", " << v[2]
              << "]";
        }
      out << "]";
    };
    out << "  {\n";
    list("centres", [&](const unsigned int i) {
      return Tensor<1, 3>(configuration.centres[i]);
    });
    out << ",\n";
    list("velocities",
         [&](const unsigned int i) { return reference[i].velocity; });
    out << ",\n";
    list("angular_velocities",
         [&](const unsigned int i) { return reference[i].angular_velocity; });
    out << "\n  }";
  }



  void
  write_problem(const std::string      &path,
                const Scene<3>         &scene,
                const Configuration<3> &now,
                const Configuration<3> &next,
                const double            tolerance)
  {
    std::ofstream out(path);
    out << std::setprecision(17) << "{\n\"lower\": [" << scene.lower()[0]
        << ", " << scene.lower()[1] << ", " << scene.lower()[2]
        << "],\n\"upper\": [" << scene.upper()[0] << ", " << scene.upper()[1]
        << ", " << scene.upper()[2] << "],\n\"tolerance\": " << tolerance
        << ",\n\"on_axis\": [";
    for (unsigned int i = 0; i < scene.particles.size(); ++i)
      out << (i > 0 ? ", " : "")
          << (scene.particles[i].on_axis ? "true" : "false");
    out << "],\n\"instants\": [\n";
    write_configuration(out, scene, now);
    out << ",\n";
    write_configuration(out, scene, next);
    out << "\n]\n}\n";
  }



  void
  run(const MeshParameters &mesh_parameters,
      const double          tolerance,
      const std::string    &directory)
  {
    LineOfParticlesParameters line(3);
    line.distance        = 2. + 2. * minimal_gap;
    const Scene<3> scene = line.scene<3>();

    Configuration<3> now;
    for (const auto &particle : scene.particles)
      now.centres.push_back(particle.centre);
    now.frame_angle = scene.line_angle(now.centres);

    MovingMesh<3>      mesh(MPI_COMM_WORLD,
                       scene,
                       generate_mesh<3>(scene, mesh_parameters));
    const MeshMover<3> mover(mesh, now);
    mesh.set_positions(straightened(mesh, mesh.positions()));
    write_mesh(directory + "/mesh.msh", mesh);

    // what the meshing took does not count
    std::ofstream("/proc/self/clear_refs") << 5;

    const RigidBodies<3>     bodies(scene);
    const NewtonianStress<3> stress;
    FlowSolverParameters     parameters;
    parameters.tolerance = tolerance;
    FlowSolver<3>             solver(parameters);
    const std::vector<double> no_forces(bodies.n_unknowns(), 0.);
    FlowFields<3>             fields     = imposed_flow(mesh, now, false);
    unsigned int              iterations = 0, step_iterations = 0;

    const double set_up =
      cpu_seconds([&] { solver.reinit(mesh, bodies, now, false); });
    const double first_assembly =
      cpu_seconds([&] { solver.assemble(now, stress); });
    const double solve =
      cpu_seconds([&] { iterations = solver.solve(fields, {}, no_forces); });
    const std::vector<RigidMotion<3>> motions = fields.motions;

    Configuration<3> next = now;
    for (unsigned int i = 0; i < next.centres.size(); ++i)
      next.centres[i] += time_step * motions[i].velocity;
    next.frame_angle = scene.line_angle(next.centres);
    mesh.set_positions(straightened(mesh, mover.positions(next)));
    {
      std::ofstream moved(directory + "/moved.txt");
      write_vertices(moved, mesh, mesh.positions(), false);
    }
    write_problem(directory + "/problem.json", scene, now, next, tolerance);

    const double assembly = cpu_seconds([&] { solver.assemble(next, stress); });
    const double step     = cpu_seconds(
      [&] { step_iterations = solver.solve(fields, {}, no_forces); });

    Utilities::System::MemoryStats memory;
    Utilities::System::get_memory_stats(memory);
    std::ofstream out(directory + "/catena.json");
    const auto    write_motions = [&](const auto &m) {
      out << "[" << m[1].velocity[0] << ", " << m[1].velocity[1] << ", "
          << m[1].angular_velocity[2] << ", " << m[0].angular_velocity[2]
          << "]";
    };
    out << std::setprecision(10) << "{\"code\": \"Catena\", \"solver\": "
        << "\"GMRES, multigrid\", \"cells\": " << mesh.n_global_cells()
        << ", \"unknowns\": " << solver.n_unknowns()
        << ", \"set_up\": " << set_up << ", \"assembly\": " << assembly
        << ", \"preconditioner\": " << first_assembly - assembly
        << ", \"solve\": " << solve << ", \"iterations\": " << iterations
        << ", \"step_assembly\": " << assembly << ", \"step_solve\": " << step
        << ", \"step_iterations\": " << step_iterations
        << ", \"memory_MB\": " << memory.VmHWM / 1024. << ", \"motions\": ";
    write_motions(motions);
    out << ", \"step_motions\": ";
    write_motions(fields.motions);
    out << "}\n";
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc != 5)
    {
      std::cerr << "Usage: catena_stokes N_PART N_MIN TOLERANCE DIRECTORY\n";
      return 1;
    }
  MeshParameters parameters;
  parameters.elements_on_equator = std::stoi(argv[1]);
  parameters.elements_across_gap = std::stoi(argv[2]);
  run(parameters, std::stod(argv[3]), argv[4]);
  return 0;
}
