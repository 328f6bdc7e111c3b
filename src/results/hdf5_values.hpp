#pragma once

#include <hdf5.h>

#include <cstddef>

#include "sweep/dataset.hpp"

namespace clatter::results::detail {

/// Number of values of a variable.
[[nodiscard]] std::size_t length_of(hid_t dataset);

/// All values of a variable, in the type that clatter writes. Throws Failure.
[[nodiscard]] sweep::ValueArray values_of(hid_t dataset);

/// Reads all values of a variable block by block, and keeps none. Throws Failure.
void try_values(hid_t dataset);

}  // namespace clatter::results::detail
