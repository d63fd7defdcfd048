#pragma once

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sundials/sundials_context.hpp>

#include <Eigen/Core>
#include <memory>
#include <type_traits>

/// Owners of SUNDIALS' objects, and views of its vectors as Eigen's.
namespace endoflow::boundary_integral {

struct VectorDeleter {
    void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
struct MatrixDeleter {
    void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
};
struct LinearSolverDeleter {
    void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};
struct CvodeDeleter {
    void operator()(void* memory) const { CVodeFree(&memory); }
};

using VectorHandle = std::unique_ptr<std::remove_pointer_t<N_Vector>, VectorDeleter>;
using MatrixHandle = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, MatrixDeleter>;
using LinearSolverHandle = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, LinearSolverDeleter>;
using CvodeHandle = std::unique_ptr<void, CvodeDeleter>;

[[nodiscard]] inline Eigen::Map<Eigen::VectorXd> values_of(N_Vector vector) {
    return {NV_DATA_S(vector), NV_LENGTH_S(vector)};
}

[[nodiscard]] inline Eigen::Map<Eigen::MatrixXd> values_of(SUNMatrix matrix) {
    return {SM_DATA_D(matrix), SM_ROWS_D(matrix), SM_COLUMNS_D(matrix)};
}

}  // namespace endoflow::boundary_integral
