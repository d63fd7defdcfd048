#include "shared/output/run_observer.h"

#include <utility>

#include "shared/output/restart_point.h"
#include "shared/support/interruption.h"

namespace endoflow {

RunObserver::RunObserver(const Parameters& parameters, const EngineIdentity& engine, std::filesystem::path directory,
                         bool continues)
    : directory_(std::move(directory)), accuracy_(parameters, engine), sudden_end_(RunDirectory{directory_}) {
    if (continues) {
        RestartPoint point = read_checkpoint({directory_});
        restart_point_ = std::move(point.checkpoint);
        record_ = std::move(point.record);
    } else {
        record_ = new_record(parameters, engine);
    }
}

bool RunObserver::stop_requested() const {
    return interruption_signal() != 0;
}

void RunObserver::record_step(HistoryRow row) {
    (void)accuracy_.look_at(row, record_);
}

void RunObserver::watch(const AccuracyBound& bound, double time_us, double value) {
    (void)AccuracyWatch::look_at(bound, time_us, value, record_);
}

void RunObserver::finish_with_error(const std::string& message) {
    leave_last_word(message.c_str());
}

}  // namespace endoflow
