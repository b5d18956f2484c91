# Finds deal.II and settles the build type. Included before project().

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release or Debug" FORCE)
elseif(NOT CMAKE_BUILD_TYPE MATCHES "^(Release|Debug)$")
  message(FATAL_ERROR
    "CMAKE_BUILD_TYPE is '${CMAKE_BUILD_TYPE}', but deal.II comes as Release "
    "and Debug only: pass -DCMAKE_BUILD_TYPE=Release or Debug.")
endif()

string(CONCAT catena_remedy
  "On Debian or Ubuntu run contrib/setup, or\n"
  "  apt-get install libdeal.ii-dev libgmsh-dev\n"
  "Elsewhere build deal.II with the missing part and pass its folder as "
  "-DDEAL_II_DIR=...\n")

find_package(deal.II 9.4 QUIET HINTS ${DEAL_II_DIR} $ENV{DEAL_II_DIR})

if(NOT deal.II_FOUND)
  if(deal.II_CONSIDERED_VERSIONS)
    message(FATAL_ERROR
      "Catena needs deal.II 9.4 or newer, found ${deal.II_CONSIDERED_VERSIONS} "
      "(${deal.II_CONSIDERED_CONFIGS}).\n${catena_remedy}")
  endif()
  message(FATAL_ERROR
    "Catena needs deal.II 9.4 or newer, found none.\n${catena_remedy}")
endif()

foreach(feature MPI TRILINOS UMFPACK METIS)
  if(NOT DEAL_II_WITH_${feature})
    list(APPEND catena_missing ${feature})
  endif()
endforeach()
if(catena_missing)
  list(JOIN catena_missing ", " catena_missing)
  message(FATAL_ERROR
    "deal.II ${DEAL_II_VERSION} in ${DEAL_II_PATH} was built without "
    "${catena_missing}, which Catena needs.\n${catena_remedy}")
endif()

# Drop what Debian adds to the flags of its packages: debug information costs a
# quarter of the compile time, the hardening run time.
separate_arguments(DEAL_II_CXX_FLAGS)
list(FILTER DEAL_II_CXX_FLAGS EXCLUDE REGEX
  "^(-g|-O2|-fstack-protector.*|-D_FORTIFY_SOURCE=.*|-ffile-prefix-map=.*)$")
list(JOIN DEAL_II_CXX_FLAGS " " DEAL_II_CXX_FLAGS)

deal_ii_initialize_cached_variables()
