#pragma once

#include <cstddef>
#include <string>

#include "certificates/certificate.hpp"
#include "sweep/sweep.hpp"

namespace clatter::certificates {

/// A certificate of a point of a sweep as one line of JSON (RFC 8259), its end included. Numbers have the digits that
/// read back to the same double.
[[nodiscard]] std::string certificate_text(const Certificate& certificate, const sweep::Sweep& sweep,
                                           std::size_t point);

}  // namespace clatter::certificates
