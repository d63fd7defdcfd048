#pragma once

namespace endoflow::phasefield {

/// ICNTL(7) of MUMPS, the order in which unknowns are eliminated. Both are parts of MUMPS itself. Where another
/// library's ordering is asked for and missing, MUMPS takes PORD, which calls exit on a complete graph, and the
/// unknowns of a cut between two processes are one.
enum class MumpsOrdering : int {
    approximate_minimum_fill = 2,      ///< work as with nested dissection, less analysis
    minimum_degree_of_quasi_dense = 6  ///< approximate minimum degree; almost full rows are left to the end
};

}  // namespace endoflow::phasefield
