// Certificates, read and proved: another program's files, or hostile ones.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <string_view>

#include "certificate_damage.hpp"
#include "finding.hpp"
#include "verify/check.hpp"
#include "verify/claims.hpp"
#include "verify/orbit.hpp"

namespace clatter::fuzz {
namespace {

using verify::Certificate, verify::Finding, verify::Verdict;

/// Whether it can be shown in a terminal.
bool is_one_line(std::string_view text) {
  return std::ranges::none_of(text, [](unsigned char c) { return c < 0x20; });
}

/// A message has to name the member, or say that it is about the line, and then the way out: "scene.h: is -1; it ...".
void require_place(const std::string& message) {
  const std::size_t told = message.find(": "), way_out = message.rfind("; ");
  const bool names_member = told != std::string::npos && told > 0 &&
                            message.find_first_not_of("abcdefghijklmnopqrstuvwxyzR_.[]0123456789") == told;
  require(names_member || message.find("line") != std::string::npos, "a message without a place: " + message);
  require(way_out != std::string::npos && way_out + 2 < message.size(), "a message without a way out: " + message);
  require(is_one_line(message), "a message with control characters: " + message);
}

double near(const verify::Number& number) { return std::abs(number.ball().near()); }

/// The fastest rate of the motion in the scene, 1/tau.
double rate_of(const Certificate::SceneNumbers& scene) {
  double stiffness = near(scene.k), damping = near(scene.h);
  for (const auto& stop : scene.stops) {
    if (!stop) continue;
    damping += near(stop->damping) * std::sqrt(near(stop->stiffness));
    stiffness += near(stop->stiffness);
  }
  return std::max({std::sqrt(stiffness), 2 * damping, near(scene.nu)});
}

/// Whether all impacts of a chatter are few enough: of an elastic stop there are thousands before it is narrow enough.
bool chatters_briefly(const Certificate& certificate) {
  const auto is_elastic = [](const auto& stop) { return stop && near(stop->R) > 0.5; };
  const auto is_exact = [](const auto& claim) { return claim && near(claim->error) < 1e-13; };
  return std::ranges::none_of(certificate.scene.stops, is_elastic) && !is_exact(certificate.x_min) &&
         !is_exact(certificate.x_max) &&
         std::ranges::none_of(certificate.events, [&](const auto& event) { return is_exact(event.until); });
}

/// Whether a number is so small that balls of 1024 bits hardly tell it from 0.
bool is_tiny(const verify::Number& number) { return near(number) > 0 && near(number) < 1e-30; }

bool has_tiny_numbers(const Certificate& certificate) {
  const auto of_stop = [](const auto& stop) { return stop && (is_tiny(stop->position) || is_tiny(stop->R)); };
  return std::ranges::any_of(certificate.scene.stops, of_stop) || is_tiny(certificate.start_x.value) ||
         is_tiny(certificate.start_v.value);
}

/// Whether most claims like it are decided within milliseconds: one may be of a million periods, or of so wide a set of
/// motions that nothing is known of them in any precision.
bool is_small(const Certificate& certificate) {
  const double rate = rate_of(certificate.scene), period = 2 * std::numbers::pi / near(certificate.scene.nu);
  const double length = certificate.end
                            ? std::abs(certificate.end->time.ball().near() - certificate.start_time.ball().near())
                            : static_cast<double>(certificate.periods) * period;
  const auto& special = certificate.special;
  if (certificate.events.size() > (special ? 3 : 4) || certificate.periods > 3 || rate * length > 50) return false;
  const double start = certificate.start_time.ball().near();
  const auto is_far = [&](const verify::Claimed& claim) {
    return rate * (std::abs(claim.value.ball().near() - start) + near(claim.error)) > 100;
  };
  const auto is_late = [&](const auto& event) { return is_far(event.time) || (event.until && is_far(*event.until)); };
  if (has_tiny_numbers(certificate) || std::ranges::any_of(certificate.events, is_late)) return false;
  if (std::max({near(certificate.start_x.error), near(certificate.start_v.error),
                special ? near(special->parameter.error) : 0.0}) > 1e-4)
    return false;
  const bool rests = std::ranges::any_of(certificate.events, [](const auto& event) { return event.until.has_value(); });
  return !rests || (rate * period < 50 && chatters_briefly(certificate));
}

/// What `check` does first, in one precision.
void follow(const Certificate& certificate) {
  verify::Report report;
  if (certificate.special) return verify::check_special(certificate, report);
  const verify::Scene scene = certificate.scene_in_balls();
  if (certificate.periodic) {
    if (!verify::steady_response(certificate, scene)) (void)verify::claimed_orbit(certificate, scene);
    return;
  }
  verify::Motion motion(scene, certificate.start_in_balls(), {verify::Ball(0), verify::Ball(0)});
  verify::Course(certificate, motion, certificate.end->time.ball()).run();
}

/// Whether few bits tell what the motion is; else all precisions up to 1024 bits are tried, which takes seconds.
bool is_told_by(slong bits, const Certificate& certificate) {
  const verify::Precision present(bits);
  try {
    follow(certificate);
  } catch (const verify::Refuted&) {
  } catch (const verify::Undecided&) {
    return false;
  }
  return true;
}

/// A claimed displacement that there is once in a motion; null: none.
verify::Claimed* displacement_of(Certificate& certificate) {
  if (certificate.end) return &certificate.end->x;
  return certificate.x_max ? &*certificate.x_max : nullptr;
}

/// Claims that contradict each other can't both be proved: the same displacement, elsewhere.
void require_no_contradiction(Certificate certificate) {
  verify::Claimed* const claimed = displacement_of(certificate);
  if (claimed == nullptr) return;
  const double value = claimed->value.ball().near(), error = near(claimed->error);
  claimed->value = verify::Number(value + 3 * error + 1e-6 * std::abs(value) + 1e-9);
  require(verify::check(certificate).verdict != Verdict::proved,
          "two displacements at once: " + claimed->value.text() + " is proved, too");
}

void check(const std::string& line) {
  Certificate certificate;
  try {
    certificate = verify::read_certificate(line);
  } catch (const verify::FormatError& error) {
    return require_place(error.what());
  }
  require(is_one_line(certificate.place), "a place with control characters: " + certificate.place);
  if (!is_small(certificate) || !is_told_by(128, certificate)) return;
  const Finding finding = verify::check(certificate);
  require(verify::bits == 64, "a precision that outlives its use");
  require(finding.bits >= 64 && finding.bits <= 1024, "a precision of " + std::to_string(finding.bits) + " bits");
  require((finding.verdict == Verdict::proved) == finding.remarks.empty(), "a verdict that its remarks don't tell");
  for (const std::string& remark : finding.remarks)
    require(is_one_line(remark), "a remark with control characters: " + remark);
  if (finding.verdict == Verdict::proved) require_no_contradiction(certificate);
}

}  // namespace
}  // namespace clatter::fuzz

extern "C" {

std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

/// Mostly changes one value of the JSON, at times bytes.
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  using Json = clatter::fuzz::CertificateDamage::Json;
  Json json = seed % 8 == 0 ? Json(Json::value_t::discarded) : Json::parse(data, data + size, nullptr, false);
  if (json.is_discarded()) return LLVMFuzzerMutate(data, size, max_size);
  clatter::fuzz::CertificateDamage damage(seed);
  for (unsigned changes = 1 + seed % 3; changes > 0; --changes) damage.apply(json);
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, text.data(), text.size());
  return text.size();
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  clatter::fuzz::check(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

}  // extern "C"
