# How Catena is compiled: options of the whole project, and two functions that
# set up the library and the programs linked with it.

add_compile_options(-Wall -Wextra -Wpedantic -Wnon-virtual-dtor)

# GCC before 13 takes what its own intrinsics for AVX-512 leave undefined for a
# mistake of the program (its bug 105593).
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-uninitialized -Wno-maybe-uninitialized)
endif()

if(CATENA_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()

# Several files at a time are included in one, which GCC then takes for headers.
if(CMAKE_UNITY_BUILD)
  add_compile_options(-Wno-subobject-linkage)
endif()

if(CATENA_SANITIZE)
  add_compile_options(-fsanitize=${CATENA_SANITIZE}
    -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  add_link_options(-fsanitize=${CATENA_SANITIZE})
endif()

# Safe with a deal.II compiled for another processor: the width of its
# VectorizedArray is fixed in its config.h, not by these flags.
if(CATENA_NATIVE)
  include(CheckCXXCompilerFlag)
  check_cxx_compiler_flag(-march=native CATENA_HAVE_MARCH_NATIVE)
  if(CATENA_HAVE_MARCH_NATIVE)
    add_compile_options(-march=native)
  endif()
endif()

# Sanitized code is for finding errors: it need not be the fastest, and compiles
# much faster for that.
set(optimization "-O3")
if(CATENA_SANITIZE)
  set(optimization "-O1")
endif()
string(REPLACE "-O2" "${optimization}" DEAL_II_CXX_FLAGS_RELEASE
  "${DEAL_II_CXX_FLAGS_RELEASE}")

# Debug checks more and steps through the code, but need not crawl. The traces of
# sanitizers ask for line numbers alone.
string(REPLACE "-O0" "-Og" DEAL_II_CXX_FLAGS_DEBUG
  "${DEAL_II_CXX_FLAGS_DEBUG}")
if(CATENA_SANITIZE)
  string(REPLACE "-ggdb" "-g1" DEAL_II_CXX_FLAGS_DEBUG
    "${DEAL_II_CXX_FLAGS_DEBUG}")
endif()

# deal_ii_setup_target() uses the plain signature of target_link_libraries(),
# so what follows must as well.
function(catena_setup_library target)
  deal_ii_setup_target(${target})
  target_link_libraries(${target} ${GMSH_LIBRARY})
  target_include_directories(${target} SYSTEM
    PUBLIC ${DEAL_II_INCLUDE_DIRS}
    PRIVATE ${GMSH_INCLUDE_DIR})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:include>)

  # DEFINE_SYMBOL would differ between the library and the programs that use
  # its precompiled header.
  set_target_properties(${target} PROPERTIES
    DEFINE_SYMBOL ""
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_precompile_headers(${target} PRIVATE
    <deal.II/base/function.h>
    <deal.II/base/mpi.h>
    <deal.II/base/parameter_handler.h>
    <deal.II/dofs/dof_tools.h>
    <deal.II/fe/fe_simplex_p.h>
    <deal.II/fe/fe_system.h>
    <deal.II/fe/fe_values.h>
    <deal.II/fe/mapping_fe_field.h>
    <deal.II/grid/tria.h>
    <deal.II/lac/affine_constraints.h>
    <deal.II/lac/la_parallel_block_vector.h>
    <deal.II/lac/trilinos_sparse_matrix.h>
    <deal.II/numerics/data_out.h>
    <deal.II/numerics/vector_tools.h>)

  # The mesher decides ties by the last digit of a size: it has to be the same in
  # a Debug build, where products and sums are not fused otherwise.
  set_source_files_properties(source/mesh/size_field.cc PROPERTIES
    COMPILE_OPTIONS "$<$<CONFIG:Debug>:-O3>"
    SKIP_PRECOMPILE_HEADERS ON
    SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

function(catena_setup_program target)
  deal_ii_setup_target(${target})
  target_link_libraries(${target} Catena::catena)
  target_precompile_headers(${target} REUSE_FROM catena)
endfunction()
