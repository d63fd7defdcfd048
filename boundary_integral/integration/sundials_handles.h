#pragma once

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sundials/sundials_context.hpp>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <type_traits>

/// SUNDIALS, version 6 or 7 and with indices of 32 or 64 bits: owners of its objects, and views of its vectors as
/// Eigen's.
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

/// Its entries are not set. Null where memory is short; so is the matrix below.
[[nodiscard]] inline VectorHandle new_vector(Eigen::Index size, SUNContext context) {
    return VectorHandle(N_VNew_Serial(static_cast<sunindextype>(size), context));
}

/// A vector in the caller's memory, which must outlive it.
[[nodiscard]] inline VectorHandle view_of(Eigen::VectorXd& values, SUNContext context) {
    return VectorHandle(N_VMake_Serial(static_cast<sunindextype>(values.size()), values.data(), context));
}

[[nodiscard]] inline MatrixHandle new_square_matrix(Eigen::Index size, SUNContext context) {
    const auto rows = static_cast<sunindextype>(size);
    return MatrixHandle(SUNDenseMatrix(rows, rows, context));
}

[[nodiscard]] inline Eigen::Map<Eigen::VectorXd> values_of(N_Vector vector) {
    return {NV_DATA_S(vector), NV_LENGTH_S(vector)};
}

[[nodiscard]] inline Eigen::Map<Eigen::MatrixXd> values_of(SUNMatrix matrix) {
    return {SM_DATA_D(matrix), SM_ROWS_D(matrix), SM_COLUMNS_D(matrix)};
}

// What versions 6 and 7 do differently.
#if SUNDIALS_VERSION_MAJOR < 7

/// What a linear solver's functions return when all went well.
inline constexpr int solver_success = SUNLS_SUCCESS;

/// CVODE's errors go to `reason`, which must outlive `cvode`, where nothing stands yet, and not to stderr; warnings are
/// left out. Returns a flag like CVODE's functions.
[[nodiscard]] inline int note_errors(void* cvode, SUNContext, std::string& reason) {
    const auto note = [](int code, const char*, const char*, char* message, void* noted) {
        auto& text = *static_cast<std::string*>(noted);
        if (code != CV_WARNING && text.empty()) text = message;
    };
    return CVodeSetErrHandlerFn(cvode, note, &reason);
}

#else

inline constexpr int solver_success = SUN_SUCCESS;

[[nodiscard]] inline int note_errors(void*, SUNContext context, std::string& reason) {
    const auto note = [](int, const char*, const char*, const char* message, SUNErrCode, void* noted, SUNContext) {
        auto& text = *static_cast<std::string*>(noted);
        if (text.empty()) text = message;
    };
    SUNLogger logger = nullptr;
    if (const int flag = SUNContext_GetLogger(context, &logger); flag != SUN_SUCCESS) return flag;
    if (const int flag = SUNLogger_SetWarningFilename(logger, ""); flag != SUN_SUCCESS) return flag;
    if (const int flag = SUNContext_ClearErrHandlers(context); flag != SUN_SUCCESS) return flag;
    return SUNContext_PushErrHandler(context, note, &reason);
}

#endif

}  // namespace endoflow::boundary_integral
