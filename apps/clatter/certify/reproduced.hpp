#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "certificates/certificate.hpp"
#include "tables/point_rows.hpp"

namespace clatter::app {

/// The name of the first result of a point of a run that a point of a file hasn't; nothing if the file has all of
/// them, to the errors that a certificate of the point states. Results of which the file has no variable aren't asked,
/// nor those that tell how the run came to its motion, nor any but `only`, if it is named.
[[nodiscard]] std::optional<std::string> difference(const PointRows& run, std::size_t point, const PointRows& file,
                                                    std::size_t point_of_file,
                                                    const std::optional<certificates::Certificate>& certificate,
                                                    std::string_view only = {});

}  // namespace clatter::app
