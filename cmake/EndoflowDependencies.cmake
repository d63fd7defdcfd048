# Libraries as imported targets. Headers of libraries count as system headers: our warnings are for our code.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(GSL REQUIRED)
find_package(SUNDIALS 6 REQUIRED COMPONENTS cvode nvecserial sunmatrixdense)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(fftw3 REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(openblas REQUIRED IMPORTED_TARGET openblas)
pkg_check_modules(lapacke REQUIRED IMPORTED_TARGET lapacke)
pkg_check_modules(hdf5_serial REQUIRED IMPORTED_TARGET hdf5-serial)

if(ENDOFLOW_TESTS)
  find_package(Catch2 2.13 REQUIRED)
endif()

if(ENDOFLOW_PHASEFIELD)
  find_package(MPI REQUIRED COMPONENTS C CXX)
  find_package(deal.II 9.4 REQUIRED)
  if(NOT DEAL_II_WITH_PETSC OR NOT DEAL_II_WITH_P4EST OR NOT DEAL_II_WITH_MPI)
    message(FATAL_ERROR "The phase-field engine needs deal.II with MPI, p4est and PETSc (Debian: libdeal.ii-dev); "
                        "or configure with -DENDOFLOW_PHASEFIELD=OFF")
  endif()
  pkg_check_modules(hdf5_openmpi REQUIRED IMPORTED_TARGET hdf5-openmpi)
endif()

# The Python that has numpy, h5py and matplotlib: Debian's, not whatever comes first on PATH.
find_program(ENDOFLOW_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
