// The sharp engine as a page's worker sees it: texts in, JSON and numbers out, a run in slices of time. A text that
// goes in is written to the memory that text_buffer() names; one that comes out ends with a zero.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boundary_integral/driver/run_loop.h"
#include "boundary_integral/simulation.h"
#include "shared/case/case_file.h"
#include "shared/output/history_columns.h"
#include "shared/output/provenance.h"
#include "shared/output/run_memory.h"
#include "shared/parameters/parameter_rendering.h"
#include "shared/support/error.h"
#include "shared/support/version.h"

namespace endoflow::web {

namespace {

using Json = nlohmann::ordered_json;

/// Calls work() and returns its JSON as text, or {"error": …} with what the command line would say.
template <class Work>
const char* answer(const Work& work) {
    static std::string text;
    Json said;
    try {
        said = work();
    } catch (const std::exception& failure) {
        said = {{"error", failure.what()}};
    }
    text = said.dump();
    return text.c_str();
}

/// The case as this engine runs it: one thread, no fields, which nobody could look at.
Parameters parameters_of(const std::string& case_text) {
    Parameters parameters = parse_case(case_text, "case.toml", {});
    boundary_integral::require_offered(parameters);
    parameters.boundary_integral.threads = 1;
    parameters.output.field_interval = 0;
    return parameters;
}

/// A run and what the page has not been told of it yet.
class Laboratory {
  public:
    explicit Laboratory(const Parameters& parameters)
        : columns_(boundary_integral::identity(parameters).history_columns),
          memory_(parameters, boundary_integral::identity(parameters)),
          run_(parameters, memory_) {}

    /// What there is before the first step.
    Json opened() {
        keep_shape();
        return told();
    }

    /// Makes steps, one at least, until `seconds` have passed or the run has ended.
    Json advance(double seconds) {
        const double begin = wall_seconds();
        std::string failure;
        try {
            do reason_ = run_.step();
            while (!reason_ && wall_seconds() - begin < seconds);
            if (reason_) memory_.finish(*reason_);
        } catch (const Error& error) {
            failure = error.what();
            memory_.finish_with_error(failure);
        }
        if (failure.empty()) keep_shape();
        Json said = told();
        if (!failure.empty()) said["error"] = failure;
        if (reason_) said["ended"] = to_string(*reason_);
        return said;
    }

    [[nodiscard]] const RunMemory& memory() const { return memory_; }
    [[nodiscard]] const std::vector<float>& shape() const { return shape_; }

  private:
    std::vector<ColumnText> columns_;  // the engine's own, of a row
    RunMemory memory_;
    boundary_integral::Run run_;
    std::optional<ExitReason> reason_;
    std::size_t rows_told_ = 0, warnings_told_ = 0;
    std::vector<float> shape_;

    /// r, z, c, u_r, u_z, one after the other.
    void keep_shape() {
        const MembraneCurve curve = memory_.rows().empty() ? memory_.shapes().front().curve : run_.shape();
        shape_.clear();
        for (const auto* values : {&curve.r, &curve.z, &curve.c, &curve.u_r, &curve.u_z})
            for (const double value : *values) shape_.push_back(static_cast<float>(value));
    }

    /// Rows and warnings since the last time, and the events.
    Json told() {
        Json rows = Json::array();
        for (; rows_told_ < memory_.rows().size(); ++rows_told_) {
            const HistoryRow& row = memory_.rows()[rows_told_];
            const auto& neck = row.membrane.neck;
            const auto maturity = value_of("maturity", row, columns_);
            rows.push_back({row.time_us, neck ? Json(neck->radius) : Json(), row.membrane.bud_height,
                            row.membrane.bending_energy, maturity ? Json(*maturity) : Json()});
        }
        Json warnings = Json::array();
        for (; warnings_told_ < memory_.warnings().size(); ++warnings_told_)
            warnings.push_back(memory_.warnings()[warnings_told_]);
        return {{"rows", rows},
                {"warnings", warnings},
                {"events", memory_.record()["events"]},
                {"time_us", memory_.record()["time_us"]}};
    }
};

std::unique_ptr<Laboratory> laboratory;
std::string text_in;

}  // namespace

}  // namespace endoflow::web

#define ENDOFLOW_EXPORT(name) extern "C" __attribute__((export_name(#name))) auto name

// NOLINTBEGIN(readability-identifier-naming): what the worker calls.

/// Memory for a text of so many bytes.
ENDOFLOW_EXPORT(text_buffer)(std::size_t size)->char* {
    endoflow::web::text_in.assign(size, ' ');
    return endoflow::web::text_in.data();
}

/// Version and parameters, as `endoflow params --json` has them, with the words that a parameter may be.
ENDOFLOW_EXPORT(describe)()->const char* {
    using namespace endoflow;
    return web::answer([] {
        auto rows = describe_parameters();
        for (std::size_t i = 0; i < rows.size(); ++i) rows[i]["choices"] = parameter_table()[i].choices;
        return web::Json{{"version", version()}, {"git", git_description()}, {"parameters", rows}};
    });
}

/// All parameters of the case in the text buffer.
ENDOFLOW_EXPORT(check)()->const char* {
    using namespace endoflow;
    return web::answer([] { return parameters_to_json(parse_case(web::text_in, "case.toml", {})); });
}

/// Opens a run of the case in the text buffer, in place of the one before.
ENDOFLOW_EXPORT(start)()->const char* {
    using namespace endoflow;
    return web::answer([] {
        const Parameters parameters = web::parameters_of(web::text_in);
        web::laboratory.reset();
        web::laboratory = std::make_unique<web::Laboratory>(parameters);
        return web::laboratory->opened();
    });
}

ENDOFLOW_EXPORT(advance)(double seconds)->const char* {
    return endoflow::web::answer([&] { return endoflow::web::laboratory->advance(seconds); });
}

/// The membrane after the last step: five times as many numbers as points.
ENDOFLOW_EXPORT(shape_data)()->const float* {
    return endoflow::web::laboratory->shape().data();
}
ENDOFLOW_EXPORT(shape_size)()->std::size_t {
    return endoflow::web::laboratory->shape().size();
}

/// history.csv, empty before the first run.
ENDOFLOW_EXPORT(history)()->const char* {
    const auto& laboratory = endoflow::web::laboratory;
    return laboratory ? laboratory->memory().history().c_str() : "";
}

// NOLINTEND(readability-identifier-naming)
