#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "certificates/certificate.hpp"
#include "scene/given_scene.hpp"

namespace clatter::certificates {

/// The point of a certificate, for people.
struct CertifiedPlace {
  std::size_t number = 0;                            ///< of the point, or of the special point
  std::optional<std::size_t> branch{};               ///< that it is on
  std::vector<std::pair<std::string, double>> at{};  ///< parameters, in the user's units
  std::optional<std::string> direction{};            ///< of a sweep both ways: up or down
  std::optional<GivenScene> machine{};               ///< with those parameters
};

/// A certificate as one line of JSON (RFC 8259), its end included. Numbers have the digits that read back to the same
/// double.
[[nodiscard]] std::string certificate_text(const Certificate& certificate, const CertifiedPlace& place);

/// The lines before and after the certificates of an output: the last one counts them, so that a file that was cut is
/// known from a whole one.
[[nodiscard]] std::string list_begin();
[[nodiscard]] std::string list_end(std::size_t count);

}  // namespace clatter::certificates
