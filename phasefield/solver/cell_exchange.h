#pragma once

#include <deal.II/base/mpi.h>

#include <cstddef>
#include <vector>

namespace endoflow::phasefield {

/// Hands a row of numbers of each own cell to the process that the cell is assigned to, and back. Rows that a process
/// is handed come in the order of the processes they come from.
class CellExchange {
  public:
    explicit CellExchange(MPI_Comm communicator) : communicator_(communicator) {}

    /// `process`: the one that each own cell is assigned to, `sizes`: of its row. Collective, as all that follows.
    void reinit(const std::vector<unsigned int>& process, const std::vector<std::size_t>& sizes);

    /// All own rows together, and where in them that of a cell begins.
    [[nodiscard]] std::size_t own_size() const { return own_.total; }
    [[nodiscard]] std::size_t begin(std::size_t cell) const { return begin_[cell]; }

    /// Whether there is but one process.
    [[nodiscard]] bool all_stay() const { return own_.parts.size() == 1; }
    template <class Number>
    void hand_over(const std::vector<Number>& own, std::vector<Number>& assigned) const {
        exchange(own, own_, assigned, assigned_);
    }
    template <class Number>
    void give_back(const std::vector<Number>& assigned, std::vector<Number>& own) const {
        exchange(assigned, assigned_, own, own_);
    }

  private:
    /// What goes to the processes, or comes from them, one after the other: `parts[i]` numbers, from `begins[i]` on.
    struct Parts {
        explicit Parts(std::vector<int> sizes = {});

        std::vector<int> parts, begins;
        std::size_t total = 0;
    };

    template <class Number>
    void exchange(const std::vector<Number>& from, const Parts& sent, std::vector<Number>& to,
                  const Parts& received) const {
        to.resize(received.total);
        const auto type = dealii::Utilities::MPI::mpi_type_id_for_type<Number>;
        MPI_Alltoallv(from.data(), sent.parts.data(), sent.begins.data(), type, to.data(), received.parts.data(),
                      received.begins.data(), type, communicator_);
    }

    MPI_Comm communicator_;
    Parts own_, assigned_;
    std::vector<std::size_t> begin_;
};

}  // namespace endoflow::phasefield
