#pragma once

#include "statics/gauss_rule.h"
#include "statics/stationary_state.h"

/// The rule with which states are found where a test does not say otherwise.
inline const endoflow::statics::GaussRule default_rule(endoflow::statics::Resolution{}.points);
