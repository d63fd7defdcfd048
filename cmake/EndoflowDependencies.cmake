# Libraries as imported targets. Headers of libraries count as system headers: our warnings are for our code.
include(EndoflowFind)
find_package(Threads REQUIRED)
find_package(Boost 1.74 REQUIRED CONFIG)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(GSL REQUIRED)
endoflow_find_library(fftw3 HEADER fftw3.h LIBRARIES fftw3 MODULES fftw3)
endoflow_find_library(openblas HEADER cblas.h LIBRARIES openblas MODULES openblas)
endoflow_find_library(lapacke HEADER lapacke.h LIBRARIES lapacke openblas MODULES lapacke)
endoflow_find_hdf5(serial)

find_package(SUNDIALS REQUIRED COMPONENTS cvode nvecserial sunmatrixdense)
if(NOT SUNDIALS_VERSION MATCHES "^[67]\\.")
  message(FATAL_ERROR "SUNDIALS ${SUNDIALS_VERSION} in ${SUNDIALS_DIR}: the boundary-integral engine needs version 6 or 7 "
                      "(Debian: libsundials-dev); say where it is by -DSUNDIALS_DIR=…")
endif()

if(ENDOFLOW_TESTS)
  find_package(Catch2 REQUIRED)
  if(NOT Catch2_VERSION MATCHES "^(2\\.1[3-9]|3)\\.")
    message(FATAL_ERROR "Catch2 ${Catch2_VERSION} in ${Catch2_DIR}: the tests need version 2.13 or 3 (Debian: catch2)")
  endif()
  if(Catch2_VERSION VERSION_GREATER_EQUAL 3)  # what version 2 calls <catch2/catch.hpp>
    target_include_directories(Catch2::Catch2 INTERFACE ${CMAKE_SOURCE_DIR}/tests/catch2-3)
  endif()
endif()

if(ENDOFLOW_PHASEFIELD)
  find_package(MPI REQUIRED COMPONENTS C CXX)
  find_package(deal.II 9.4 REQUIRED)
  if(NOT DEAL_II_WITH_PETSC OR NOT DEAL_II_WITH_P4EST OR NOT DEAL_II_WITH_MPI)
    message(FATAL_ERROR "The phase-field engine needs deal.II with MPI, p4est and PETSc (Debian: libdeal.ii-dev); "
                        "or configure with -DENDOFLOW_PHASEFIELD=OFF")
  endif()
  endoflow_find_hdf5(openmpi)
endif()

# The Python of `endoflow compare` and its like: the system's where it has what they import, or the first on PATH that has.
function(endoflow_imports_packages accepted python)
  execute_process(COMMAND ${python} -c "import numpy, scipy, h5py, matplotlib, emcee" RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  if(failed)
    set(${accepted} FALSE PARENT_SCOPE)
  endif()
endfunction()
find_program(ENDOFLOW_PYTHON NAMES python3 HINTS /usr/bin VALIDATOR endoflow_imports_packages)
if(NOT ENDOFLOW_PYTHON)
  unset(ENDOFLOW_PYTHON CACHE)  # comparisons/ says what is missing
  find_program(ENDOFLOW_PYTHON NAMES python3 HINTS /usr/bin REQUIRED)
endif()
