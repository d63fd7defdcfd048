#pragma once

// What tests include as <catch2/catch.hpp> where Catch2 is of version 3, which has no such header: version 2's names.

#include <catch2/catch_approx.hpp>
#include <catch2/catch_session.hpp>
#include <catch2/catch_template_test_macros.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators_all.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <string>

using Catch::Approx;

namespace Catch {
namespace Matchers {

[[nodiscard]] inline StringContainsMatcher Contains(const std::string& text) {
    return ContainsSubstring(text);
}

}  // namespace Matchers

using Matchers::Contains;

}  // namespace Catch

#ifdef CATCH_CONFIG_MAIN
int main(int argc, char** argv) {
    return Catch::Session().run(argc, argv);
}
#endif
