#pragma once

#include <hdf5.h>

#include <cstddef>
#include <string>
#include <vector>

#include "results/dataset.hpp"
#include "results/hdf5_handle.hpp"

namespace clatter::results::detail {

/// Number of values of a variable.
[[nodiscard]] std::size_t length_of(hid_t dataset);

/// All values of a variable, in the type that clatter writes. Throws Failure.
[[nodiscard]] ValueArray values_of(hid_t dataset);

/// The values of some rows of a variable, those of its first dimension from `first` on. Throws Failure.
[[nodiscard]] ValueArray rows_of(hid_t dataset, std::size_t first, std::size_t rows);

/// Reads all values of a variable block by block, and keeps none. Throws Failure.
void try_values(hid_t dataset);

/// The type of all texts: UTF-8 of variable length. Every reader of netCDF-4 takes it; ncdump of Debian 12 dies of
/// texts of fixed length.
[[nodiscard]] Handle text_type();

[[nodiscard]] bool is_text(hid_t dataset);

/// The most bytes of a text among the values of a variable.
inline constexpr std::size_t longest_text = 255;

/// The texts of a variable, in their order. Throws Failure, also if one is longer than `longest_text`: all values of a
/// file that somebody else made may refer to the same long text.
[[nodiscard]] std::vector<std::string> read_texts(hid_t dataset);

/// Reads them all, and keeps none.
void try_texts(hid_t dataset);

}  // namespace clatter::results::detail
