# Finds the gmsh library with its C++ interface: target Catena::gmsh.

find_path(GMSH_INCLUDE_DIR gmsh.h HINTS ${GMSH_DIR}/include)
find_library(GMSH_LIBRARY gmsh HINTS ${GMSH_DIR}/lib)
mark_as_advanced(GMSH_INCLUDE_DIR GMSH_LIBRARY)

if(NOT GMSH_INCLUDE_DIR OR NOT GMSH_LIBRARY)
  message(FATAL_ERROR
    "Catena needs the gmsh library and its C++ header gmsh.h, not only the "
    "program gmsh.\n"
    "On Debian or Ubuntu run contrib/setup, or\n"
    "  apt-get install libgmsh-dev\n"
    "Elsewhere pass the folder of a gmsh SDK as -DGMSH_DIR=...\n")
endif()
