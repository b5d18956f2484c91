# Installs the library, its headers and a package for find_package(Catena).

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(catena_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/Catena")

configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/contrib/cmake/CatenaConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/CatenaConfig.cmake"
  INSTALL_DESTINATION "${catena_package_dir}")
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/CatenaConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)

install(TARGETS catena EXPORT CatenaTargets)
install(DIRECTORY include/catena TYPE INCLUDE)
install(EXPORT CatenaTargets
  NAMESPACE Catena::
  DESTINATION "${catena_package_dir}")
install(FILES
  "${PROJECT_BINARY_DIR}/CatenaConfig.cmake"
  "${PROJECT_BINARY_DIR}/CatenaConfigVersion.cmake"
  DESTINATION "${catena_package_dir}")
