#include "phasefield/solver/cell_exchange.h"

#include <utility>

namespace endoflow::phasefield {

CellExchange::Parts::Parts(std::vector<int> sizes) : parts(std::move(sizes)) {
    for (const int part : parts) {
        begins.push_back(static_cast<int>(total));
        total += static_cast<std::size_t>(part);
    }
}

void CellExchange::reinit(const std::vector<unsigned int>& process, const std::vector<std::size_t>& sizes) {
    const unsigned int processes = dealii::Utilities::MPI::n_mpi_processes(communicator_);
    std::vector<int> sent(processes), received(processes);
    for (std::size_t cell = 0; cell < process.size(); ++cell) sent[process[cell]] += static_cast<int>(sizes[cell]);
    MPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, communicator_);
    own_ = Parts(std::move(sent));
    assigned_ = Parts(std::move(received));
    std::vector<std::size_t> next(own_.begins.begin(), own_.begins.end());
    begin_.clear();
    for (std::size_t cell = 0; cell < process.size(); ++cell) {
        begin_.push_back(next[process[cell]]);
        next[process[cell]] += sizes[cell];
    }
}

}  // namespace endoflow::phasefield
