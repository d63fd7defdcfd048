#pragma once

#include <deal.II/base/mpi.h>

#include <cstddef>
#include <vector>

namespace endoflow::phasefield {

/// Each number becomes its sum over all processes; collective.
inline void sum_over_processes(const std::vector<double*>& numbers, MPI_Comm communicator) {
    std::vector<double> values;
    for (const double* number : numbers) values.push_back(*number);
    dealii::Utilities::MPI::sum(values, communicator, values);
    for (std::size_t i = 0; i < values.size(); ++i) *numbers[i] = values[i];
}

/// Each number becomes the largest of all processes; collective.
inline void largest_of_processes(const std::vector<double*>& numbers, MPI_Comm communicator) {
    std::vector<double> values;
    for (const double* number : numbers) values.push_back(*number);
    dealii::Utilities::MPI::max(values, communicator, values);
    for (std::size_t i = 0; i < values.size(); ++i) *numbers[i] = values[i];
}

}  // namespace endoflow::phasefield
