#include "terminal/table_options.hpp"

#include <filesystem>
#include <span>

#include "storage/atomic_write.hpp"
#include "storage/error.hpp"
#include "storage/free_name.hpp"
#include "storage/utf8.hpp"

namespace clatter::app {

std::vector<Condition> conditions_of(const Arguments& arguments) try {
  std::vector<Condition> conditions;
  for (const std::string& text : arguments.values("where")) {
    conditions.push_back(condition_of(text));
    const Condition& last = conditions.back();
    for (const Condition& other : std::span(conditions).first(conditions.size() - 1))
      if (other.name == last.name && other.comparison == Comparison::equal && last.comparison == Comparison::equal &&
          other.word != last.word)
        throw UsageError("--where " + storage::excerpt(text_of(last)) + " beside --where " +
                         storage::excerpt(text_of(other)) + "; a point has one value of it");
  }
  return conditions;
} catch (const ChoiceError& error) {
  throw UsageError(error.what());
}

std::optional<std::string> text_output_of(const Arguments& arguments, FileKind kind) {
  const std::string output = arguments.value("output").value_or("-");
  if (output == "-") return std::nullopt;
  check_not_input(arguments.operands[0], output, "the input");
  check_name(output, kind);
  storage::check_writable(output);
  std::error_code error;
  if (std::filesystem::exists(output, error) && !arguments.has("force"))
    throw storage::IoError("cannot write " + storage::quoted_name(output) + ": there is a file; " +
                           storage::instead_of_replacing(output));
  return output;
}

}  // namespace clatter::app
