#pragma once

#include <string>

#include "shared/parameters/parameters.h"

namespace endoflow::cli {

/// CSV of the constitutive laws (Fig. A.2) with a membrane's stiffnesses and curvature: c from 0 to 1, then for each
/// law LAW_b_pN_nm = b(c) and LAW_H0_per_nm = H0(c), before any curvature convention.
[[nodiscard]] std::string constitutive_laws_csv(const MembraneParameters& membrane);

}  // namespace endoflow::cli
