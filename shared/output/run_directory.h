#pragma once

#include <filesystem>
#include <vector>

namespace endoflow {

/// The names in a run's directory; every reader and writer takes them from here.
struct RunDirectory {
    std::filesystem::path root;

    [[nodiscard]] std::filesystem::path record() const { return root / "run.json"; }
    [[nodiscard]] std::filesystem::path history() const { return root / "history.csv"; }
    [[nodiscard]] std::filesystem::path shapes() const { return root / "shapes.h5"; }
    [[nodiscard]] std::filesystem::path log() const { return root / "log.txt"; }
    [[nodiscard]] std::filesystem::path checkpoint() const { return root / "checkpoint"; }
    [[nodiscard]] std::filesystem::path shapes_at_checkpoint() const { return checkpoint() / "shapes.h5"; }
    [[nodiscard]] std::filesystem::path fields() const { return root / "fields"; }
    [[nodiscard]] std::filesystem::path field_index() const { return root / "fields.pvd"; }
    /// What commands draw from the run where nobody says otherwise: `movie`, `report`, `revolve`.
    [[nodiscard]] std::vector<std::filesystem::path> drawings() const {
        return {root / "movie.mp4", root / "report", root / "membrane", root / "membrane.pvd"};
    }
    [[nodiscard]] std::filesystem::path earlier() const { return root / "earlier"; }
    [[nodiscard]] std::filesystem::path lock() const { return root / "lock"; }
    /// Why a process that is not the directory's owner ended; the owner reads and removes it.
    [[nodiscard]] std::filesystem::path word_of_a_process() const { return root / "process-ended"; }

    /// Makes root if it is not there. Throws IoError when it cannot be written.
    void make_root() const;
    /// Makes checkpoint/; moves a run that is already there, and what was drawn from it, to earlier/N/. Throws IoError.
    void prepare_fresh() const;
    /// Whether a checkpoint is there to continue from.
    [[nodiscard]] bool holds_checkpoint() const;
    /// Throws IoError unless root holds a run that can be continued.
    void require_run() const;
};

}  // namespace endoflow
