// Writes the seeds of the fuzzers, a folder for each, and a dictionary of words:
// fuzz_seeds CONFIGS CERTIFICATES CORPUS
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/config_text.hpp"
#include "config/keys.hpp"
#include "crafted.hpp"
#include "journal_damage.hpp"
#include "results/dataset_file.hpp"

namespace clatter::fuzz {
namespace {

namespace fs = std::filesystem;

/// The fuzzers that read HDF5 files.
constexpr std::array file_readers{"info", "merge"};

std::string content_of(const fs::path& path) {
  std::ifstream file{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{file}, {}};
}

void write_seed(const fs::path& folder, const std::string& name, std::string_view bytes) {
  fs::create_directories(folder);
  std::ofstream{folder / name, std::ios::binary} << bytes;
}

/// Configurations as they are, and the values in them.
void write_configurations(const fs::path& configs, const fs::path& corpus) {
  std::set<std::string> values;
  for (const fs::directory_entry& entry : fs::directory_iterator(configs)) {
    const std::string kind = entry.path().extension().string();
    if (kind != ".toml" && kind != ".ini") continue;
    const std::string text = content_of(entry.path());
    write_seed(corpus / kind.substr(1), entry.path().stem(), text);
    for (std::size_t begin = 0; (begin = text.find("= ", begin)) != std::string::npos; ++begin) {
      std::string value = text.substr(begin + 2, text.find_first_of("#;\n", begin) - begin - 2);
      std::erase(value, '"');
      values.insert(value);
    }
  }
  for (const std::string more :
       {"pi", "-2*pi/3", "inf", "[0.5, 1e-3, pi]", "logspace(1, 1e-3, 4)", "arange(0, 1, 0.1)"})
    values.insert(more);
  int number = 0;
  for (const std::string& value : values) {  // the first byte chooses the kind of value
    write_seed(corpus / "value", "number" + std::to_string(++number), '\0' + value);
    write_seed(corpus / "value", "axis" + std::to_string(number), '\1' + value);
  }
  write_seed(corpus / "toml", "defaults", default_config(config::Format::toml));
  write_seed(corpus / "ini", "defaults", default_config(config::Format::ini));
}

/// Each line of a file of certificates.
void write_certificates(const fs::path& certificates, const fs::path& corpus) {
  std::ifstream file{certificates};
  int number = 0;
  for (std::string line; std::getline(file, line);) write_seed(corpus / "certificate", std::to_string(++number), line);
  if (number == 0) throw std::runtime_error("no certificate in " + certificates.string());
}

/// Words for libFuzzer to insert: all those of configurations.
void write_dictionary(const fs::path& corpus) {
  std::set<std::string> words{"linspace(", "logspace(", "arange(", "pi", "inf", "nan", "true", "false", "[[", "]]"};
  for (const std::string_view section : config::sections()) words.insert('[' + std::string(section) + ']');
  for (const Key& key : config::keys()) {
    words.insert(std::string(key.name) + " = ");
    words.insert(key.choices.begin(), key.choices.end());
  }
  std::string text = "\"\\\"\\\"\\\"\"\n";  // three quotes
  for (const std::string& word : words) text += '"' + word + "\"\n";
  write_seed(corpus, "words", text);
}

std::vector<double> ramp(std::size_t size) {
  std::vector<double> values(size);
  for (std::size_t i = 0; i < size; ++i) values[i] = std::sqrt(static_cast<double>(i));
  return values;
}

/// Files with all kinds of contents: coordinates, scales without one, flags, integers, short and long texts, deflated
/// values.
results::Dataset figure(std::size_t points, std::size_t samples) {
  const std::vector<std::uint8_t> flags{0, 1, 2, 16, 17, 18};
  const std::string meanings = "periodic aperiodic transient event_budget not_finite unresolved";
  return {{{"nu", points}, {"sample", samples}},
          {{"nu", {"nu"}, ramp(points), "excitation frequency", "1"},
           {"status",
            {"nu"},
            std::vector<std::uint8_t>(points),
            "outcome",
            "1",
            {{"flag_values", flags}, {"flag_meanings", meanings}}},
           {"impact_total", {"nu"}, std::vector<std::int64_t>(points, 7), "impacts", "1"},
           {"x", {"nu", "sample"}, ramp(points * samples), "displacement", "1"}},
          {{"shard", "0/1"}, {"instruction_set", "sse2"}, {"rounding", "sse2"}}};
}

results::Dataset scalar() { return {{}, {{"x_min", {}, std::vector<double>{-0.5}, "least displacement", "1"}}}; }

void write_files(const fs::path& corpus) {
  results::FileHead config;
  config.title = "Größter Ausschlag";
  config.text = "[scene]\nxs = -4.0\n[sweep]\nnu = \"linspace(1, 2, 2)\"\n[observe]\ntrajectory = 2\n";
  const auto seed = [&](const std::string& name, std::string_view bytes) {
    for (const char* const reader : file_readers) write_seed(corpus / reader, name, bytes);
  };
  const auto write = [&](const std::string& name, results::Dataset what, int compression) {
    config.compression = compression;
    const std::vector<std::byte> bytes = results::file_image(std::move(what), config);
    seed(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  };
  write("small", figure(2, 2), 0);
  for (const auto& [name, bytes] : crafted_files(content_of(corpus / "info" / "small"))) seed(name, bytes);
  config.text = "[scene]\nxs = -4.0\n[sweep]\nnu = \"linspace(1, 2, 60)\"\n[observe]\ntrajectory = 40\n";
  write("deflated", figure(60, 40), 9);
  config.text = "[scene]\nxs = -4.0\n";
  write("scalar", scalar(), 0);
  write("empty", {{{"impact", 0}}, {{"impact_tau", {"impact"}, std::vector<double>{}, "time of impact", "1"}}}, 0);
}

}  // namespace
}  // namespace clatter::fuzz

int main(int argc, char** argv) try {
  using namespace clatter::fuzz;
  if (argc != 4) throw std::runtime_error("usage: fuzz_seeds CONFIGS CERTIFICATES CORPUS");
  const fs::path corpus = argv[3];
  write_configurations(argv[1], corpus);
  write_certificates(argv[2], corpus);
  write_dictionary(corpus);
  write_files(corpus);
  for (const auto& [name, bytes] : journal_seeds()) write_seed(corpus / "journal", name, bytes);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "fuzz_seeds: %s\n", error.what());
  return 1;
}
