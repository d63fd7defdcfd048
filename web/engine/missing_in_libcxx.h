#pragma once

// What the standard library of emscripten 3.1.6 (Debian 12) lacks of C++20. Each part is left out where the library
// says that it has it. Read before every source file.

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>
#include <version>

_LIBCPP_BEGIN_NAMESPACE_STD

#ifndef __cpp_lib_jthread
/// A page's engine computes in one thread: nothing ever starts one.
class jthread {
  public:
    template <class Function, class... Arguments>
    explicit jthread(Function&& function, Arguments&&... arguments)
        : thread_(std::forward<Function>(function), std::forward<Arguments>(arguments)...) {}
    jthread(jthread&&) = default;
    jthread& operator=(jthread&&) = default;
    ~jthread() {
        if (thread_.joinable()) thread_.join();
    }

  private:
    std::thread thread_;
};
#endif

#ifndef __cpp_lib_to_chars
inline from_chars_result from_chars(const char* begin, const char* end, double& value) {
    const string text(begin, end);
    char* rest = nullptr;
    value = std::strtod(text.c_str(), &rest);
    if (rest == text.c_str()) return {begin, errc::invalid_argument};
    return {begin + (rest - text.c_str()), errc()};
}
#endif

#ifndef __cpp_lib_ranges
namespace ranges {
template <class Range, class Predicate>
bool all_of(const Range& range, const Predicate& predicate) {
    return std::all_of(range.begin(), range.end(), predicate);
}
}  // namespace ranges
#endif

_LIBCPP_END_NAMESPACE_STD
