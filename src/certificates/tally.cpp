#include "certificates/tally.hpp"

#include <algorithm>
#include <string_view>

namespace clatter::certificates {
namespace {

std::string name_of(steady::Status status) {
  if (failed(status)) return "failed";
  return std::string(std::ranges::find(steady::status_names, status, &steady::StatusName::status)->name);
}

std::string reason_of(const CertifiedPoint& point) {
  switch (point.without) {
    case Without::force:
      return "without a force";
    case Without::family:
      return "one of a family";
    case Without::cut_chatter:
      return "cut within a chatter";
    case Without::soft_wall:
      return "with a soft wall of the loose mass";
    case Without::force_shape:
      return "under a force in pieces";
    case Without::stop_motion:
      return "between stops that move by themselves";
    case Without::law_of_speed:
      return "with a restitution that depends on the speed in a chatter or a special point";
    case Without::loose_friction:
      return "with friction in a chatter of the loose mass";
    case Without::both_held:
      return "with both masses held at once";
    case Without::one_instant:
      return "with two events at one instant";
    case Without::no_such_claim:
      return "special without a claim of its kind";
    case Without::rounding:
      return "lost in rounding";
    default:
      return name_of(point.status);
  }
}

std::size_t sum_of(const std::map<std::string, std::size_t>& counts) {
  std::size_t sum = 0;
  for (const auto& [name, count] : counts) sum += count;
  return sum;
}

std::string counted(std::size_t count, std::string_view noun) {
  return std::to_string(count) + ' ' + std::string(noun) + (count == 1 ? "" : "s");
}

/// " (70 aperiodic, 8 failed)", or nothing.
std::string details(const std::map<std::string, std::size_t>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) (text += text.empty() ? " (" : ", ") += std::to_string(count) + ' ' + name;
  return text.empty() ? text : text + ')';
}

}  // namespace

void Tally::add(const CertifiedPoint& point) {
  if (!point.differs.empty())
    ++not_reproduced_[point.differs];
  else if (point.certificate)
    ++certificates_[point.certificate->special ? point.certificate->special->kind : name_of(point.status)];
  else
    ++without_[reason_of(point)];
}

std::string Tally::text() const {
  const std::size_t certificates = sum_of(certificates_), without = sum_of(without_);
  const std::size_t not_reproduced = sum_of(not_reproduced_);
  std::string text = counted(certificates + without + not_reproduced, "point") + ": " +
                     counted(certificates, "certificate") + details(certificates_);
  if (without > 0) text += ", " + std::to_string(without) + " without a claim" + details(without_);
  if (not_reproduced > 0) text += ", " + std::to_string(not_reproduced) + " not reproduced" + details(not_reproduced_);
  return text;
}

}  // namespace clatter::certificates
